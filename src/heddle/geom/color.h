#pragma once

#include <heddle/base/vec.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace heddle {

/// Packs linear RGB as CurveSet::color stores it: 8 bits each in bits 0 to 23, rounded.
/// @param linear  values outside [0, 1] are clamped
[[nodiscard]] inline std::uint32_t pack_color(Vec3f linear) {
    std::uint32_t out = 0;
    for (int c = 0; c < 3; ++c) {
        const float v = std::clamp(linear[c], 0.0f, 1.0f) * 255.0f + 0.5f;
        out |= static_cast<std::uint32_t>(v) << (8 * c);
    }
    return out;
}

// sRGB of one channel [IEC 61966-2-1]. T is float or double, and the choice is visible: in double,
// 30 of 10 million floats become another byte, and one of the 256 bytes (111) becomes another
// 16-bit linear value. The shader of window/presenter.cpp has the same curve.

/// @param linear  in [0, 1]
/// @return        in [0, 1]
template <typename T>
[[nodiscard]] T srgb_from_linear(T linear) {
    return linear <= T(0.0031308) ? T(12.92) * linear
                                  : T(1.055) * std::pow(linear, T(1) / T(2.4)) - T(0.055);
}
/// @param srgb  in [0, 1]
/// @return      in [0, 1]
template <typename T>
[[nodiscard]] T linear_from_srgb(T srgb) {
    return srgb <= T(0.04045) ? srgb / T(12.92) : std::pow((srgb + T(0.055)) / T(1.055), T(2.4));
}
/// @param linear  values outside [0, 1] are clamped; NaN gives 0
template <typename T>
[[nodiscard]] std::uint8_t srgb_byte(T linear) {
    const T inside = linear > T(0) ? std::min(linear, T(1)) : T(0);
    return static_cast<std::uint8_t>(srgb_from_linear(inside) * T(255) + T(0.5));
}
template <typename T>
[[nodiscard]] T linear_from_srgb_byte(std::uint8_t byte) {
    return linear_from_srgb(static_cast<T>(byte) / T(255));
}

} // namespace heddle
