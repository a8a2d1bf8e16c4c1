#pragma once

#include <heddle/voxel/voxel_grid.h>

#include <memory>
#include <string>

namespace heddle {

/// Reads level 0 of a .vdb that Heddle wrote.
///
/// Blocks hold the leaves of one 64^3 cell each, ascending (x, y, z). `density` and the direction
/// grids are not read: they follow from the rest.
/// @throws Error  NotFound, BadFile: not a VDB, truncated, not Heddle's (its grids are listed), a
///                later format, a grid missing or out of step with `coverage`, a lobe of weight 0,
///                without material or not positive definite; Unsupported: see read_contents
[[nodiscard]] std::unique_ptr<VoxelGrid> read_vdb(const std::string& path);

} // namespace heddle
