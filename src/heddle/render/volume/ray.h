#pragma once

#include <heddle/base/vec.h>

#include <limits>

namespace heddle {

/// A ray with the width of what it stands for.
struct Ray {
    Vec3d origin;                                         ///< scene units
    Vec3f direction;                                      ///< unit
    float t_max = std::numeric_limits<float>::infinity(); ///< scene units
    float width = 0.0f;                                   ///< of the footprint at the origin
    float spread = 0.0f;                                  ///< growth of the width per unit of t
    float clear = 0.0f; ///< no volume stops it before this t: it starts on what is there
    float bulk = 0.0f;  ///< 1: it runs into the bulk of what it starts on; 0: in the open

    [[nodiscard]] Vec3d at(double t) const { return origin + to_double(direction) * t; }
    [[nodiscard]] float width_at(float t) const { return width + spread * t; }
};

} // namespace heddle
