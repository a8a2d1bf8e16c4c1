#pragma once

#include <heddle/base/vec.h>

#include <limits>

namespace heddle {

/// The fiber of a volume that a ray leaves, and what is known of the way on which light came to it.
struct FiberStart {
    float radius = 0.0f; ///< scene units; 0: the ray does not leave a fiber, or it is unknown
    float cosine = 0.0f; ///< between the ray and the way back
    float free = 0.0f;   ///< length of the way back that is known to be free, scene units
};

/// A ray with the width of its footprint.
struct Ray {
    Vec3d origin;                                         ///< scene units
    Vec3f direction;                                      ///< unit
    float t_max = std::numeric_limits<float>::infinity(); ///< scene units
    float width = 0.0f;                                   ///< of the footprint at the origin
    float spread = 0.0f;                                  ///< growth of the width per unit of t
    float clear = 0.0f; ///< volumes are ignored for t < clear (self-shadowing)
    FiberStart start{};

    [[nodiscard]] Vec3d at(double t) const { return origin + to_double(direction) * t; }
    [[nodiscard]] float width_at(float t) const { return width + spread * t; }
};

} // namespace heddle
