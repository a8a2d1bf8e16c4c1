#pragma once

#include <heddle/voxel/voxel_level.h>
#include <heddle/voxelize/block/accumulator.h>
#include <heddle/voxelize/block/fit_options.h>

namespace heddle {

/// What a block's sums amounted to; for the planner's estimates.
struct BlockCounts {
    std::int64_t voxels = 0;
    std::int64_t lobes = 0;
    std::int64_t leaves = 0;
    std::int64_t subvoxels = 0;       ///< hit
    std::int64_t triangles = 0;       ///< that were binned to the block
    std::int64_t triangle_hits = 0;   ///< centre lines of columns that they meet
    std::int64_t surface_samples = 0; ///< that maps and normals were read for
};

/// Fits every voxel of the block and appends it to `out`, leaf by leaf.
///
/// Coverage is popcount / columns per axis, occupancy hit / all subvoxels [Fabre26, eq. 12], both
/// rounded to 16 bits. A lobe's S is the SGGX whose second moment is the pooled one
/// (sggx/moments.h).
/// Of more than max_lobes materials those whose directions are closest share a lobe.
BlockCounts fit_block(const BlockSums& sums, const FitOptions& options, VoxelBlock& out);

} // namespace heddle
