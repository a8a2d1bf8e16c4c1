#pragma once

#include <heddle/base/platform.h>
#include <heddle/yarn/piece_id.h>

#include <cstdint>

namespace heddle {

/// A primitive of a block: the id of a fiber piece, or the number of a triangle with the top bit
/// set. In ascending order, pieces precede triangles.
using Primitive = std::uint64_t;
constexpr Primitive kTriangleBit = Primitive{1} << 63;

[[nodiscard]] HEDDLE_HD constexpr Primitive pack_triangle(std::uint64_t triangle) {
    return triangle | kTriangleBit;
}
/// Returns the number of a triangle over all meshes of the geometry.
/// @param primitive  a triangle
[[nodiscard]] HEDDLE_HD constexpr std::uint64_t triangle_of(Primitive primitive) {
    return primitive & ~kTriangleBit;
}

} // namespace heddle
