#pragma once

#include <heddle/base/vec.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>

namespace heddle {

/// Linear RGB as control points carry it (CurveSet::color): 8 bits each in bits 0 to 23, rounded.
/// @param linear  what lies outside [0, 1] is clamped
[[nodiscard]] inline std::uint32_t pack_color(Vec3f linear) {
    std::uint32_t out = 0;
    for (int c = 0; c < 3; ++c) {
        const float v = std::clamp(linear[c], 0.0f, 1.0f) * 255.0f + 0.5f;
        out |= static_cast<std::uint32_t>(v) << (8 * c);
    }
    return out;
}

/// A linear value in 8 bits by the sRGB curve, rounded.
/// @tparam T      precision in which the curve is taken
/// @param linear  clamped to [0, 1]; NaN gives 0
template <std::floating_point T>
[[nodiscard]] std::uint8_t encode_srgb(T linear) {
    const T c = linear > T(0) ? std::min(linear, T(1)) : T(0);
    const T s = c <= T(0.0031308) ? T(12.92) * c : T(1.055) * std::pow(c, T(1) / T(2.4)) - T(0.055);
    return static_cast<std::uint8_t>(s * T(255) + T(0.5));
}

} // namespace heddle
