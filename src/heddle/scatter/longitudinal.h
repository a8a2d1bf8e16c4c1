#pragma once

#include <heddle/base/trig.h>
#include <heddle/scatter/approximate.h>
#include <heddle/scatter/fiber_frame.h>

#include <algorithm>
#include <cmath>

namespace heddle::detail {

/// The smallest variance that floats resolve: the square of 0.003 radians.
inline constexpr float kMinVariance = 1e-5f;

/// The spread along the fiber of a cone of light that leaves it: a Gaussian on the sphere.
///
/// M = exp((cos(a + b) - 1) / v) e^-x I_0(x) / (v (1 - e^(-2 / v))), x = cos a cos b / v
/// [d'Eon 2011]; the integral of M cos b over b is 1 for any a and v.
///
/// @param a  inclination of the light's cone; the lobe is about b = -a
/// @param b  inclination at which the density is evaluated
/// @param v  variance, radians^2, kMinVariance or more
[[nodiscard]] inline float longitudinal(Inclination a, Inclination b, float v) {
    const float p = a.cos - b.cos;
    const float q = a.sin + b.sin;
    const float inverse = 1.0f / v;
    const float spread = -0.5f * inverse * (p * p + q * q); // (cos(a + b) - 1) / v, not cancelling
    const float whole = v < 0.1f ? v : v * (1.0f - exp_approx(-2.0f * inverse)); // no e^-20
    return exp_approx(spread) * scaled_bessel_i0(a.cos * b.cos * inverse) / whole;
}

/// Draws b with density M cos b.                         [d'Eon 2013, "A fiber scattering model"]
/// @param u, t  uniform in [0, 1)
[[nodiscard]] inline Inclination sample_longitudinal(Inclination a, float v, float u, float t) {
    // a point about the pole -a: first 1 minus its cosine, then its azimuth
    const float drawn = u + (1.0f - u) * exp_approx(-2.0f / v);
    const float fall = std::min(2.0f, -v * std::log(std::max(drawn, 1e-37f)));
    const float across = std::sqrt(std::max(0.0f, fall * (2.0f - fall)));
    const float cosine = sincos_turns(static_cast<double>(t)).cos;
    const float s = (fall - 1.0f) * a.sin + across * cosine * a.cos;
    const float sine = std::min(1.0f, std::max(-1.0f, s));
    return {sine, std::sqrt(std::max(0.0f, 1.0f - sine * sine))};
}

} // namespace heddle::detail
