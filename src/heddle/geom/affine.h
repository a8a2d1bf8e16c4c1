#pragma once

#include <heddle/base/vec.h>

#include <cmath>

namespace heddle {

/// The map x -> A x + b.
struct Affine {
    Vec3d x{1, 0, 0}; ///< image of the x axis: the first column of A
    Vec3d y{0, 1, 0};
    Vec3d z{0, 0, 1};
    Vec3d offset{};

    [[nodiscard]] Vec3d direction(Vec3d d) const { return x * d.x + y * d.y + z * d.z; }
    [[nodiscard]] Vec3d point(Vec3d p) const { return direction(p) + offset; }
    [[nodiscard]] double determinant() const { return dot(x, cross(y, z)); }
    friend bool operator==(const Affine&, const Affine&) = default;
};

/// The map that applies `b` first, then `a`.
[[nodiscard]] inline Affine operator*(const Affine& a, const Affine& b) {
    return {a.direction(b.x), a.direction(b.y), a.direction(b.z), a.point(b.offset)};
}

/// The inverse map. @param a  with a determinant other than 0
[[nodiscard]] inline Affine inverse(const Affine& a) {
    const double k = 1.0 / a.determinant();
    const Vec3d r0 = cross(a.y, a.z) * k; // rows of the inverse
    const Vec3d r1 = cross(a.z, a.x) * k;
    const Vec3d r2 = cross(a.x, a.y) * k;
    Affine out{{r0.x, r1.x, r2.x}, {r0.y, r1.y, r2.y}, {r0.z, r1.z, r2.z}, {}};
    out.offset = out.direction(a.offset) * -1.0;
    return out;
}

} // namespace heddle
