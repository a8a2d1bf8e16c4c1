#pragma once

#include <heddle/voxel/voxel_level.h>

#include <span>
#include <string>
#include <vector>

namespace heddle {

/// The metadata strings of a file: docs/format.md lists their keys.
struct InfoJson {
    std::string info;      ///< `heddle_info`: an object
    std::string materials; ///< `heddle_materials`: an array by material id
    std::string yarns;     ///< `heddle_yarns`: an array
};

/// The counts of one level; all else is shared by the levels.
struct LevelCounts {
    std::int64_t voxel_count = 0;
    std::int64_t lobe_count = 0;
    Vec3i lo; ///< first active voxel
    Vec3i hi; ///< last active voxel, inclusive; both meaningless without voxels
};

/// @param finest  level 0; its own counts are ignored
/// @param levels  finest first, at least one
[[nodiscard]] InfoJson to_json(const VoxelLevelInfo& finest, std::span<const LevelCounts> levels);

/// The metadata string `heddle_materials`.
[[nodiscard]] std::string materials_to_json(const std::vector<Material>& materials);

/// The reverse of to_json: one info per level, finest first. `fields` is not in the strings and
/// keeps its default.
/// @param path    for messages
/// @throws Error  BadFile: a key is missing, of another type or out of range
[[nodiscard]] std::vector<VoxelLevelInfo> infos_from_json(const InfoJson& json,
                                                          const std::string& path);

} // namespace heddle
