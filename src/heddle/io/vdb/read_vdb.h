#pragma once

#include <heddle/voxel/voxel_grid.h>

#include <memory>
#include <string>
#include <vector>

namespace heddle {

/// What a .vdb that Heddle wrote says of its levels, finest first; no voxel is read.
/// @throws Error  NotFound; BadFile: not a VDB, truncated, not Heddle's (its grids are listed),
///                metadata that cannot be used, a level missing, a grid there twice; Unsupported:
///                a later format, or see read_contents
[[nodiscard]] std::vector<VoxelGridInfo> read_infos(const std::string& path);

/// Reads one level.
///
/// Blocks hold the leaves of one 32^3 cell each, ascending (x, y, z). `density` and the direction
/// grids are not read: they follow from the rest. Memory: the level's blocks, and beside them first
/// `coverage` and `lobe_k`, then one other grid at a time.
/// @param level   from 0, the finest
/// @throws Error  as read_infos; NotFound: no such level (says how many there are); BadFile: a grid
///                missing or out of step with `coverage`, counts that differ from the metadata, a
///                lobe of weight 0, without material or not positive definite, a merge order that
///                cannot be
[[nodiscard]] std::unique_ptr<VoxelGrid> read_vdb(const std::string& path, int level = 0);

/// Reads all levels: each a VoxelGrid.
/// @throws Error  as read_vdb
[[nodiscard]] VoxelLevels read_levels(const std::string& path);

} // namespace heddle
