#pragma once

// Elementary functions without branches or library calls, so that loops over them are vectorized.

#include <heddle/base/trig.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace heddle::detail {

inline constexpr float kPi = 3.14159265f;
inline constexpr float kTwoPi = 6.28318531f;
inline constexpr float kInversePi = 0.318309886f;

/// The nearest whole number, for |x| < 2^31: std::floor is a library call before SSE 4.1.
[[nodiscard]] inline float round_to_whole(float x) {
    return static_cast<float>(static_cast<std::int32_t>(x + (x < 0.0f ? -0.5f : 0.5f)));
}

/// e^x with a relative error of 2e-7 for x in [-87, 88]; outside, the value at the nearer end.
[[nodiscard]] inline float exp_approx(float x) {
    x = std::min(88.0f, std::max(-87.0f, x)); // NaN gives -87
    const float n = round_to_whole(x * 1.44269504f);
    const float r = (x - n * 0.693359375f) + n * 2.12194440e-4f; // ln 2 in two parts
    const float tail = r * (1.0f / 24 + r * (1.0f / 120 + r * (1.0f / 720)));
    const float e = 1.0f + r * (1.0f + r * (0.5f + r * (1.0f / 6 + tail)));
    return e * std::bit_cast<float>((static_cast<std::int32_t>(n) + 127) << 23);
}

/// Arc cosine of x in [-1, 1] within 4e-7.                     [Abramowitz and Stegun, 4.4.46]
[[nodiscard]] inline float acos_approx(float x) {
    const float a = std::min(1.0f, std::fabs(x));
    float p = -0.0012624911f;
    p = p * a + 0.0066700901f;
    p = p * a - 0.0170881256f;
    p = p * a + 0.0308918810f;
    p = p * a - 0.0501743046f;
    p = p * a + 0.0889789874f;
    p = p * a - 0.2145988016f;
    p = p * a + 1.5707963050f;
    p *= std::sqrt(1.0f - a);
    return x < 0.0f ? kPi - p : p;
}

/// e^-x I_0(x), x >= 0: the scaled modified Bessel function; within 3e-7.   [ibid., 9.8.1, 9.8.2]
[[nodiscard]] inline float scaled_bessel_i0(float x) {
    if (x < 3.75f) {
        const float t = x * x * (1.0f / 14.0625f);
        float p = 0.0045813f;
        p = p * t + 0.0360768f;
        p = p * t + 0.2659732f;
        p = p * t + 1.2067492f;
        p = p * t + 3.0899424f;
        p = p * t + 3.5156229f;
        return (p * t + 1.0f) * exp_approx(-x);
    }
    const float t = 3.75f / x;
    float p = 0.00392377f;
    p = p * t - 0.01647633f;
    p = p * t + 0.02635537f;
    p = p * t - 0.02057706f;
    p = p * t + 0.00916281f;
    p = p * t - 0.00157565f;
    p = p * t + 0.00225319f;
    p = p * t + 0.01328592f;
    return (p * t + 0.39894228f) / std::sqrt(x);
}

} // namespace heddle::detail
