#pragma once

#include <heddle/base/vec.h>

#include <cmath>

namespace heddle::detail {

/// The angle to the plane across a fiber, as its sine and cosine; the cosine is not negative.
struct Inclination {
    float sin = 0.0f;
    float cos = 1.0f;
};

/// The inclination rotated by an angle; beyond the axis it stays on its side, with |cos|.
[[nodiscard]] inline Inclination turn(Inclination a, float sine, float cosine) {
    return {a.sin * cosine + a.cos * sine, std::fabs(a.cos * cosine - a.sin * sine)};
}

/// The axes of a fiber; x is `wi` without its component along the fiber, so wi has azimuth 0.
struct FiberFrame {
    Vec3f x, y, axis;
    Inclination in;

    FiberFrame(Vec3f tangent, Vec3f wi) : axis(tangent) {
        in.sin = dot(wi, tangent);
        const Vec3f across = wi - tangent * in.sin;
        in.cos = length(across);
        // along the axis there is no azimuth: any will do, if all calls use the same one
        x = in.cos > 1e-6f ? across * (1.0f / in.cos) : any_perpendicular(tangent);
        y = cross(axis, x);
    }

    /// The components of `w` along x, y and the axis.
    [[nodiscard]] Vec3f local(Vec3f w) const { return {dot(w, x), dot(w, y), dot(w, axis)}; }
    [[nodiscard]] Vec3f world(Vec3f w) const { return x * w.x + y * w.y + axis * w.z; }
};

} // namespace heddle::detail
