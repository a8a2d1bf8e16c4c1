#pragma once

#include <heddle/base/progress.h>
#include <heddle/voxel/voxel_grid.h>

#include <cstdint>
#include <string>

namespace heddle {

/// How a volume is written for Mitsuba 0.6.
struct Mitsuba06Options {
    double stddev = 0.3;             ///< of the flakes about the fiber, as Mitsuba has it
    std::int32_t block_samples = 64; ///< along a block's edge, 2 to 512; 0: one block holds all
};

/// What was written for Mitsuba 0.6.
struct Mitsuba06Files {
    Vec3i samples;             ///< of the whole box, empty blocks included
    Vec3i block_samples;       ///< of a block
    Vec3i cells;               ///< blocks per axis, empty ones included
    std::int64_t blocks = 0;   ///< that hold something
    std::int64_t bytes = 0;    ///< of all files
    double scale = 0.0;        ///< the medium's: extinction per scene unit at density 1
    std::int64_t no_fiber = 0; ///< voxels without a fiber lobe: written without a direction
};

/// Writes a volume as [LopezMoreno17, 5.2] did: DIR/volume.vol, a `hgridvolume` dictionary, and for each
/// block that has voxels DIR/density_XXX_YYY_ZZZ.vol (a byte a sample) and DIR/orientation_... (two
/// bytes: the angles of the heaviest fiber lobe's direction), neighbours sharing a layer of samples;
/// and DIR/scene.xml, a medium of microflakes about fibers.
///
/// Density is what makes the mean extinction over the axes that of the voxel (docs/import.md, inverted);
/// the densest voxel has 255. The folder is made.
/// @throws Error  InvalidArgument: no voxels, more than 999 blocks along an axis, or one block of more
///                than 2^31 samples; CannotWrite; Cancelled
Mitsuba06Files write_mitsuba06(const VoxelSource& source,
                               const std::string& folder,
                               const Mitsuba06Options& options,
                               Progress& progress);

} // namespace heddle
