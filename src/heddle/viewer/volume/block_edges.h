#pragma once

#include <heddle/base/vec.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace heddle::viewer {

/// The edges of occupied blocks, each once: touching blocks share theirs.
/// @param blocks  indices
/// @param size    of a block, scene units
/// @param middle  origin of the result, scene units
/// @return        first corner, scene units from `middle`, and axis: 0, 1 or 2
[[nodiscard]] std::vector<std::array<float, 4>>
edges_of_blocks(std::span<const Vec3i> blocks, Vec3d size, Vec3d middle);

/// The first occupied block that a ray hits; none if it hits none.
/// @param blocks  indices, ascending x, then y, then z
/// @param from    in blocks; with `whole`, blocks behind it count too
/// @param way     in blocks, nonzero length
[[nodiscard]] std::optional<Vec3i>
first_block(std::span<const Vec3i> blocks, Vec3d from, Vec3d way, bool whole);

} // namespace heddle::viewer
