#pragma once

#include <heddle/lod/build_levels.h>
#include <heddle/voxel/voxel_level.h>
#include <heddle/voxelize/plan.h>

#include <cstdint>
#include <optional>

namespace heddle::job {

/// How much an object's levels hold.
struct LevelCounts {
    std::int64_t levels = 0;
    std::int64_t voxels = 0; ///< of the finest
    std::int64_t lobes = 0;
    std::int64_t all_voxels = 0; ///< of all levels
    std::int64_t all_lobes = 0;
};

/// @param levels  finest first, at least one
[[nodiscard]] LevelCounts count_levels(const VoxelLevels& levels);

/// What levels are to be built.
/// @param levels  above the finest, at most; none: until two voxels an axis are left
/// @throws OptionError  a number of levels out of range
[[nodiscard]] LodOptions
lod_options(LodMethod lod, const std::optional<int>& levels, std::uint64_t seed);

/// Bytes of the .vdb that a plan's voxels and levels will be, about.
[[nodiscard]] std::int64_t predict_file_bytes(const VoxelizePlan& plan);

} // namespace heddle::job
