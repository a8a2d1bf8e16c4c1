#pragma once

#include <heddle/base/trig.h>
#include <heddle/base/vec.h>

#include <cmath>

namespace heddle::detail {

/// Draws a direction about z with density cos / pi.
[[nodiscard]] inline Vec3f sample_cosine(float a, float b) {
    const SinCos turn = sincos_turns(static_cast<double>(b));
    const float r = std::sqrt(a);
    return {r * turn.cos, r * turn.sin, std::sqrt(1.0f - a)};
}

[[nodiscard]] inline Vec3f to_world(Vec3f w, Vec3f x, Vec3f y, Vec3f z) {
    return normalize(x * w.x + y * w.y + z * w.z, z);
}

} // namespace heddle::detail
