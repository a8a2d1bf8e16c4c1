#pragma once

#include <heddle/io/vdb/vdb_file.h>
#include <heddle/voxel/voxel_grid.h>

#include <memory>
#include <string>

namespace heddle {

/// Reads the grids of one level. Each is decoded whole: `coverage` and `lobe_k` together, the rest
/// one after the other.
/// @param info    of the level, fields included
/// @throws Error  BadFile: a grid is missing, damaged or out of step with `coverage`; counts are
///                not as in `info`; a lobe or a merge order that cannot be
[[nodiscard]] std::unique_ptr<VoxelGrid>
read_level(const std::string& path, const VdbContents& file, const VoxelGridInfo& info);

} // namespace heddle
