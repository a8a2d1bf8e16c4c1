#pragma once

#include <heddle/voxel/voxel_level.h>

#include <memory>
#include <string>
#include <vector>

namespace heddle {

/// Reads the infos of the levels of a .vdb of Heddle, finest first; no voxel is read.
/// @throws Error  NotFound; BadFile: not a VDB, truncated, not Heddle's (its grids are listed),
///                unusable metadata, a missing level, a duplicate grid; Unsupported: a later
///                format, or as read_contents
[[nodiscard]] std::vector<VoxelLevelInfo> read_infos(const std::string& path);

/// Reads one level.
///
/// Each block has the leaves of one cell of 32^3 voxels, ascending (x, y, z). `density` and the
/// direction grids are not read: they are derived from the others. Memory: the level's blocks, and
/// in addition first `coverage` and `lobe_k`, then one other grid at a time.
/// @param level   from 0, the finest
/// @throws Error  as read_infos; NotFound: no such level (tells how many exist); BadFile: a grid is
///                missing or inconsistent with `coverage`, counts differ from the metadata, a lobe
///                has weight 0, no material or is not positive definite, an invalid merge order
[[nodiscard]] std::unique_ptr<MemoryLevel> read_vdb(const std::string& path, int level = 0);

/// Reads all levels, each as a MemoryLevel.
/// @throws Error  as read_vdb
[[nodiscard]] VoxelLevels read_levels(const std::string& path);

} // namespace heddle
