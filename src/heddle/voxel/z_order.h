#pragma once

#include <heddle/base/vec.h>

#include <cstdint>

namespace heddle {

/// Returns true if cell `a` comes before `b` in Z-order, where the 2 x 2 x 2 children of a cell
/// floor(i / 2) follow each other, on every level. Negative indices come first.
[[nodiscard]] constexpr bool z_order_less(Vec3i a, Vec3i b) {
    const auto differ = [&](int k) {
        return static_cast<std::uint32_t>(a[k]) ^ static_cast<std::uint32_t>(b[k]);
    };
    int axis = 0;
    for (int k = 1; k < 3; ++k) { // find the axis with the highest differing bit
        const std::uint32_t best = differ(axis);
        const std::uint32_t here = differ(k);
        if (best < here && best < (best ^ here)) axis = k;
    }
    return a[axis] < b[axis];
}

} // namespace heddle
