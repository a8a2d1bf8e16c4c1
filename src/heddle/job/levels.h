#pragma once

#include <heddle/lod/build_levels.h>
#include <heddle/voxel/voxel_level.h>
#include <heddle/voxelize/plan.h>

#include <cstdint>
#include <optional>

namespace heddle::job {

/// Numbers of levels, voxels and lobes of an object.
struct LevelCounts {
    std::int64_t levels = 0;
    std::int64_t voxels = 0;     ///< of the finest level
    std::int64_t lobes = 0;      ///< of the finest level
    std::int64_t all_voxels = 0; ///< of all levels
    std::int64_t all_lobes = 0;
};

/// Counts the voxels and lobes of an object.
/// @param levels  finest first, at least one
[[nodiscard]] LevelCounts count_levels(const VoxelLevels& levels);

/// Returns the options by which LevelBuilder builds the levels.
/// @param levels  most levels above the finest; none: until two voxels per axis are left
/// @throws OptionError  the number of levels is out of range
[[nodiscard]] LodOptions
lod_options(LodMethod lod, const std::optional<int>& levels, std::uint64_t seed);

/// Returns about how many bytes a .vdb of the planned voxels and levels will have.
[[nodiscard]] std::int64_t predict_file_bytes(const VoxelizePlan& plan);

} // namespace heddle::job
