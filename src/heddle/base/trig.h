#pragma once

#include <heddle/base/platform.h>

namespace heddle {

struct SinCos {
    float sin = 0.0f;
    float cos = 1.0f;
};

/// The largest integer <= x, for |x| < 2^31, without a library call.
[[nodiscard]] HEDDLE_HD constexpr int floor_to_int(float x) {
    const int i = static_cast<int>(x);
    return i - (static_cast<float>(i) > x ? 1 : 0);
}

/// a / b, rounded towards minus infinity; b > 0.
template <typename T>
[[nodiscard]] HEDDLE_HD constexpr T floor_div(T a, T b) {
    return a >= 0 ? a / b : -((-a + b - 1) / b);
}

/// Sine and cosine of an angle in turns: sin(2 pi turns), cos(2 pi turns).
///
/// Uses only + - * and conversions, so every backend gives the same bits.  |turns| < 2^40.
/// @return  both within 2e-7
[[nodiscard]] HEDDLE_HD constexpr SinCos sincos_turns(double turns) {
    const auto whole = static_cast<long long>(turns * 4.0 + (turns < 0.0 ? -0.5 : 0.5));
    const double x = (turns * 4.0 - static_cast<double>(whole)) * 1.5707963267948966; // +- pi/4
    const double y = x * x;
    // Taylor to x^11 and x^12: the first term left out is below 1e-11 at pi/4
    const double s =
        x * (1.0 + y * (-1.0 / 6 + y * (1.0 / 120 + y * (-1.0 / 5040 + y * (1.0 / 362880)))));
    const double c =
        1.0 + y * (-0.5 + y * (1.0 / 24 + y * (-1.0 / 720 + y * (1.0 / 40320 - y / 3628800))));
    const auto sf = static_cast<float>(s);
    const auto cf = static_cast<float>(c);
    switch (whole & 3) {
    case 0: return {sf, cf};
    case 1: return {cf, -sf};
    case 2: return {-sf, -cf};
    default: return {-cf, sf};
    }
}

} // namespace heddle
