#pragma once

#include <heddle/base/vec.h>

#include <algorithm>
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

} // namespace heddle
