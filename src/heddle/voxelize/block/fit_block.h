#pragma once

#include <heddle/voxel/voxel_level.h>
#include <heddle/voxelize/block/accumulator.h>
#include <heddle/voxelize/block/fit_options.h>

namespace heddle {

/// Counts of a block, for the planner's estimates.
struct BlockCounts {
    std::int64_t voxels = 0;
    std::int64_t lobes = 0;
    std::int64_t leaves = 0;
    std::int64_t subvoxels = 0;       ///< occupied subvoxels
    std::int64_t triangles = 0;       ///< triangles that were assigned to the block
    std::int64_t triangle_hits = 0;   ///< centre lines of columns that the triangles intersect
    std::int64_t surface_samples = 0; ///< evaluations of maps and normals
};

/// Fits every voxel of the block and appends it to `out`, leaf by leaf.
///
/// Coverage is popcount / columns per axis and occupancy is hit / all subvoxels [Fabre26, eq. 12],
/// both rounded to 16 bits. A lobe's S is the SGGX with the pooled second moment (sggx/moments.h).
/// If there are more than max_lobes materials, those with the closest directions share a lobe.
BlockCounts fit_block(const BlockSums& sums, const FitOptions& options, VoxelBlock& out);

} // namespace heddle
