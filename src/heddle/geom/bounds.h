#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>

#include <algorithm>
#include <limits>

namespace heddle {

/// Axis-aligned box in scene units. Starts empty (lo > hi).
struct Bounds {
    Vec3d lo{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
             std::numeric_limits<double>::infinity()};
    Vec3d hi{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity()};

    /// Grows the box to contain the ball of radius `r` around `p`.
    HEDDLE_HD void grow(Vec3d p, double r = 0.0) {
        for (int a = 0; a < 3; ++a) {
            lo[a] = std::min(lo[a], p[a] - r);
            hi[a] = std::max(hi[a], p[a] + r);
        }
    }
    HEDDLE_HD void grow(const Bounds& b) {
        for (int a = 0; a < 3; ++a) {
            lo[a] = std::min(lo[a], b.lo[a]);
            hi[a] = std::max(hi[a], b.hi[a]);
        }
    }
    [[nodiscard]] HEDDLE_HD bool empty() const {
        return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z);
    }
    [[nodiscard]] HEDDLE_HD Vec3d size() const { return empty() ? Vec3d{} : hi - lo; }
};

} // namespace heddle
