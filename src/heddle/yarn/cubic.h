#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>
#include <heddle/geom/bounds.h>

namespace heddle {

/// The cubic P(t) = c[0] + c[1] t + c[2] t^2 + c[3] t^3. slice/slice_glsl.h has the same code in
/// GLSL, which cannot include C++, and also that of yarn_section.h and the frames of
/// fiber_source.cpp.
/// @tparam T  float or double
template <typename T>
struct PowerCubic {
    Vec3<T> c[4];
    [[nodiscard]] HEDDLE_HD Vec3<T> at(T t) const {
        return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
    }
    [[nodiscard]] HEDDLE_HD Vec3<T> derivative(T t) const {
        return c[1] + t * (T(2) * c[2] + (T(3) * t) * c[3]);
    }
    [[nodiscard]] HEDDLE_HD Vec3<T> second_derivative(T t) const {
        return T(2) * c[2] + (T(6) * t) * c[3];
    }
};

/// A cubic piece for t in [0, 1], in scene units.
struct Cubic : PowerCubic<double> {
    /// Returns the part [t0, t0 + dt] as a cubic of its own.
    [[nodiscard]] HEDDLE_HD Cubic part(double t0, double dt) const {
        return {{at(t0), dt * derivative(t0), (dt * dt) * (c[2] + (3.0 * t0) * c[3]),
                 (dt * dt * dt) * c[3]}};
    }
    /// Returns the length of its control polygon, an upper bound of the arc length.
    [[nodiscard]] HEDDLE_HD double polygon_length() const {
        // Bernstein differences: c1 / 3, (c1 + c2) / 3, (c1 + 2 c2 + 3 c3) / 3 ... in power form
        const Vec3d b1 = (1.0 / 3.0) * c[1];
        const Vec3d b2 = b1 + (1.0 / 3.0) * c[2];
        const Vec3d b3 = b2 + (1.0 / 3.0) * c[2] + c[3];
        return length(b1) + length(b2) + length(b3);
    }
    /// Returns the box of its control polygon, which contains the arc.
    [[nodiscard]] HEDDLE_HD Bounds hull() const {
        Bounds box;
        const Vec3d p1 = c[0] + (1.0 / 3.0) * c[1];
        const Vec3d p2 = p1 + (1.0 / 3.0) * c[1] + (1.0 / 3.0) * c[2];
        box.grow(c[0]);
        box.grow(p1);
        box.grow(p2);
        box.grow(at(1.0));
        return box;
    }
};
static_assert(sizeof(Cubic) == 96, "the same on host and device");

} // namespace heddle
