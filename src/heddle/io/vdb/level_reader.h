#pragma once

#include <heddle/io/vdb/vdb_file.h>
#include <heddle/voxel/voxel_level.h>

#include <memory>
#include <string>

namespace heddle {

/// Reads the grids of one level. Each is decoded as a whole: `coverage` and `lobe_k` together, then
/// the others one at a time.
/// @param info    of the level, including the fields
/// @throws Error  BadFile: a grid is missing, damaged or inconsistent with `coverage`; counts
///                differ from `info`; an invalid lobe or merge order
[[nodiscard]] std::unique_ptr<MemoryLevel>
read_level(const std::string& path, const VdbContents& file, const VoxelLevelInfo& info);

} // namespace heddle
