#pragma once

#include <heddle/base/vec.h>

#include <cstdint>

namespace heddle {

/// True when cell `a` comes before `b` in Z-order: the 2 x 2 x 2 cells of a parent floor(i / 2),
/// and of its parent, and so on, follow each other. Negative indices come first.
[[nodiscard]] constexpr bool z_order_less(Vec3i a, Vec3i b) {
    const auto differ = [&](int k) {
        return static_cast<std::uint32_t>(a[k]) ^ static_cast<std::uint32_t>(b[k]);
    };
    int axis = 0;
    for (int k = 1; k < 3; ++k) { // the axis whose highest differing bit is the highest of all
        const std::uint32_t best = differ(axis);
        const std::uint32_t here = differ(k);
        if (best < here && best < (best ^ here)) axis = k;
    }
    return a[axis] < b[axis];
}

} // namespace heddle
