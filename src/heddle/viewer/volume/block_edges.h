#pragma once

#include <heddle/base/vec.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace heddle::viewer {

/// Edges of occupied blocks, each once: blocks that touch share theirs.
/// @param blocks  indices
/// @param size    of a block, scene units
/// @param middle  scene units: places count from here
/// @return        first corner, scene units from `middle`, and axis: 0, 1 or 2
[[nodiscard]] std::vector<std::array<float, 4>>
edges_of_blocks(std::span<const Vec3i> blocks, Vec3d size, Vec3d middle);

/// The first occupied block that a ray meets; none where it meets none.
/// @param blocks  indices, ascending x, then y, then z
/// @param from    in blocks; with `whole`, what lies behind it counts too
/// @param way     in blocks, any length but 0
[[nodiscard]] std::optional<Vec3i>
first_block(std::span<const Vec3i> blocks, Vec3d from, Vec3d way, bool whole);

} // namespace heddle::viewer
