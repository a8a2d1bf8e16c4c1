#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/bounds.h>

#include <algorithm>

namespace heddle {

/// A part of a ray; empty where t0 >= t1.
struct RayRange {
    float t0, t1;
};

/// The part of [t_min, t_max] of a ray that is inside a box.
/// @param direction  of any length, which is the unit of t
[[nodiscard]] inline RayRange
clip(Vec3d origin, Vec3d direction, float t_min, float t_max, const Bounds& box) {
    double t0 = static_cast<double>(t_min);
    double t1 = static_cast<double>(t_max);
    for (int a = 0; a < 3; ++a) {
        if (direction[a] == 0.0) {
            if (!(origin[a] >= box.lo[a] && origin[a] <= box.hi[a])) return {0.0f, 0.0f};
            continue;
        }
        const double inverse = 1.0 / direction[a];
        const double p = (box.lo[a] - origin[a]) * inverse;
        const double q = (box.hi[a] - origin[a]) * inverse;
        t0 = std::max(t0, std::min(p, q));
        t1 = std::min(t1, std::max(p, q));
    }
    return {static_cast<float>(t0), static_cast<float>(t1)};
}

} // namespace heddle
