#pragma once

#include <heddle/sggx/packed.h>

#include <cstdint>

namespace heddle {

/// True when the bytes decode to a positive definite S: every sigma above 0 and the determinant of
/// [1 r_xy r_xz; r_xy 1 r_yz; r_xz r_yz 1] above 0, in exact integers (255 r is one).
[[nodiscard]] inline bool decodes_positive_definite(PackedSggx p) {
    if (p.sigma[0] == 0 || p.sigma[1] == 0 || p.sigma[2] == 0) return false;
    const auto r = [&](int i) { return std::int64_t{2} * p.r[i] - 255; };
    const std::int64_t one = 255, a = r(0), b = r(1), c = r(2);
    if (a * a >= one * one) return false;
    return one * (one * one - a * a - b * b - c * c) + 2 * a * b * c > 0;
}

} // namespace heddle
