#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>

#include <cmath>

namespace heddle {

/// Symmetric 3x3 matrix in world axes, order xx yy zz xy xz yz: an SGGX's S, or a second moment.
///
/// Heddle's S is scaled so that the distribution integrates to 1 over the sphere; sqrt(w^T S w) is
/// then the mean of |w . d| over its directions d, and at most 1.
struct SymmetricMatrix {
    float xx = 0.0f, yy = 0.0f, zz = 0.0f, xy = 0.0f, xz = 0.0f, yz = 0.0f;
};
using SggxMatrix = SymmetricMatrix;

/// S w.
[[nodiscard]] HEDDLE_HD inline Vec3f multiply(const SymmetricMatrix& S, Vec3f w) {
    return {S.xx * w.x + S.xy * w.y + S.xz * w.z, S.xy * w.x + S.yy * w.y + S.yz * w.z,
            S.xz * w.x + S.yz * w.y + S.zz * w.z};
}

/// Projected area of the microflake ellipsoid seen along `w`.
///
/// sigma(w) = sqrt(w^T S w)                                            [Heitz15, sec. 3]
///
/// @param S  positive semi-definite; entries finite
/// @param w  unit, world axes
/// @return   in [0, sqrt(largest eigenvalue of S)], unitless
[[nodiscard]] HEDDLE_HD inline float projected_area(const SggxMatrix& S, Vec3f w) {
    const float q = dot(w, multiply(S, w));
    return std::sqrt(q > 0.0f ? q : 0.0f); // rounding can make q slightly negative for flat S
}

} // namespace heddle
