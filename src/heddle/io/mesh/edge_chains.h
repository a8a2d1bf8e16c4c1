#pragma once

#include <heddle/geom/curves.h>

#include <array>
#include <span>

namespace heddle {

/// Joins single edges into polylines: chains pass through points where exactly two edges meet, and
/// end at all other points; rings become closed curves. Edges from a point to itself are ignored.
/// @param points  n, scene units
/// @param radius  n, scene units, or empty
/// @param edges   pairs of indices < n
/// @return        Basis::Linear; open chains in the order of their first edge, then rings
[[nodiscard]] CurveSet chain_edges(std::span<const Vec3f> points,
                                   std::span<const float> radius,
                                   std::span<const std::array<std::uint32_t, 2>> edges);

} // namespace heddle
