#pragma once

#include <heddle/voxel/voxel_grid.h>

#include <string>

namespace heddle {

/// The metadata strings of a file: docs/format.md lists their keys.
struct InfoJson {
    std::string info;      ///< `heddle_info`: an object
    std::string materials; ///< `heddle_materials`: an array by material id
    std::string yarns;     ///< `heddle_yarns`: an array
};

/// @param lo, hi  first and last active voxel, inclusive; for the bounds in scene units
[[nodiscard]] InfoJson to_json(const VoxelGridInfo& info, Vec3i lo, Vec3i hi);

/// The reverse; `fields` is not in the strings and stays as default.
/// @param path    for messages
/// @throws Error  BadFile when a key is missing, of another type or out of range
[[nodiscard]] VoxelGridInfo info_from_json(const InfoJson& json, const std::string& path);

} // namespace heddle
