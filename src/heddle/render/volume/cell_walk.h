#pragma once

#include <heddle/base/vec.h>
#include <heddle/render/volume/cell_columns.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace heddle {

namespace detail {

/// The steps of a ray from cell to cell along one axis.
struct CellAxis {
    float next; ///< t at the next face
    float per;  ///< growth of t per cell
    int bits;   ///< change of the bit's number; 0: the ray does not move
    int left;   ///< cells behind this one in the voxel
    int at;     ///< index of the cell
};

/// @param in         0 to 4, in cells
/// @param direction  cells per unit of t
/// @param bits       distance of the bits of neighbouring cells
[[nodiscard]] inline CellAxis start_axis(float in, float direction, int bits) {
    const int at = std::clamp(static_cast<int>(in), 0, kCells - 1);
    constexpr float kMin = 1e-20f; // slower rays stay in their cell
    if (std::fabs(direction) < kMin) return {std::numeric_limits<float>::max(), 0.0f, 0, 0, at};
    const float per = 1.0f / direction;
    if (direction > 0.0f) {
        return {(static_cast<float>(at + 1) - in) * per, per, bits, kCells - 1 - at, at};
    }
    return {(static_cast<float>(at) - in) * per, -per, -bits, at, at};
}

} // namespace detail

/// Calls visit(t0, t1) -> bool for the parts of a ray in set cells of a voxel, in order, until it
/// returns false. Neighbouring set cells are one part.
/// @param cells      the voxel's
/// @param in         where the ray enters, in [0, 1]^3 of the voxel
/// @param direction  voxels per unit of t
/// @param length     t at which the ray leaves the voxel; 0 where it enters
/// @return           false: visit() did
template <typename Visit>
bool visit_set_cells(
    std::uint64_t cells, Vec3f in, Vec3f direction, float length, const Visit& visit) {
    if (cells == ~std::uint64_t{0}) return visit(0.0f, length);
    detail::CellAxis axis[3] = {detail::start_axis(in.x * kCells, direction.x * kCells, 16),
                                detail::start_axis(in.y * kCells, direction.y * kCells, 4),
                                detail::start_axis(in.z * kCells, direction.z * kCells, 1)};
    int bit = (axis[0].at * kCells + axis[1].at) * kCells + axis[2].at;
    float t = 0.0f, begin = -1.0f; // begin of the part; -1: none
    for (;;) {
        const int a = axis[0].next < axis[1].next ? (axis[0].next < axis[2].next ? 0 : 2)
                                                  : (axis[1].next < axis[2].next ? 1 : 2);
        detail::CellAxis& next = axis[a];
        const bool set = (cells >> bit & 1) != 0;
        if (set && begin < 0.0f) begin = t;
        if (!set && begin >= 0.0f) {
            if (!visit(begin, t)) return false;
            begin = -1.0f;
        }
        if (next.next >= length || next.left == 0) break;
        t = std::max(t, next.next);
        next.next += next.per;
        --next.left;
        bit += next.bits;
    }
    return begin < 0.0f || visit(begin, length);
}

} // namespace heddle
