#pragma once

#include <heddle/base/progress.h>
#include <heddle/voxel/voxel_level.h>

#include <cstdint>
#include <string>

namespace heddle {

/// Options for writing a volume for Mitsuba 0.6.
struct Mitsuba06Options {
    double stddev = 0.3; ///< standard deviation of the flakes around the fiber, as in Mitsuba
    std::int32_t block_samples = 64; ///< along the edge of a block, 2 to 512; 0: one block for all
};

/// The files that were written for Mitsuba 0.6.
struct Mitsuba06Files {
    Vec3i samples;             ///< of the whole box, including empty blocks
    Vec3i block_samples;       ///< per block
    Vec3i cells;               ///< blocks per axis, including empty ones
    std::int64_t blocks = 0;   ///< blocks that are not empty
    std::int64_t bytes = 0;    ///< of all files
    double scale = 0.0;        ///< of the medium: extinction per scene unit at density 1
    std::int64_t no_fiber = 0; ///< voxels without a fiber lobe: written without a direction
};

/// Writes a volume as [LopezMoreno17, 5.2] did: DIR/volume.vol, a `hgridvolume` dictionary; for
/// each block with voxels DIR/density_XXX_YYY_ZZZ.vol (one byte per sample) and DIR/orientation_...
/// (two bytes: the angles of the direction of the heaviest fiber lobe), where neighbours share a
/// layer of samples; and DIR/scene.xml, a medium of microflakes around fibers.
///
/// The density of a sample has the extinction of its voxel, averaged over the axes (the inverse of
/// docs/import.md); the densest voxel has 255. The folder is created.
/// @throws Error  InvalidArgument: no voxels, more than 999 blocks along an axis, or one block of
///                more than 2^31 samples; CannotWrite; Cancelled
Mitsuba06Files write_mitsuba06(const VoxelLevel& source,
                               const std::string& folder,
                               const Mitsuba06Options& options,
                               Progress& progress);

} // namespace heddle
