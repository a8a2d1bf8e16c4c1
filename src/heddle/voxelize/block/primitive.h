#pragma once

#include <heddle/base/platform.h>
#include <heddle/yarn/piece_id.h>

#include <cstdint>

namespace heddle {

/// A primitive of a block: a fiber piece's id, or a triangle's number with the top bit set. So
/// ascending order puts the pieces before the triangles.
using Primitive = std::uint64_t;
constexpr Primitive kTriangleBit = Primitive{1} << 63;

[[nodiscard]] HEDDLE_HD constexpr Primitive pack_triangle(std::uint64_t triangle) {
    return triangle | kTriangleBit;
}
/// @param primitive  a triangle
/// @return           its number over all meshes of the geometry
[[nodiscard]] HEDDLE_HD constexpr std::uint64_t triangle_of(Primitive primitive) {
    return primitive & ~kTriangleBit;
}

} // namespace heddle
