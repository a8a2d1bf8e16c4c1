#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/random.h>
#include <heddle/base/trig.h>
#include <heddle/base/vec.h>
#include <heddle/sggx/sggx.h>

#include <cmath>
#include <cstdint>

namespace heddle {

/// The density of directions, per steradian over the whole sphere.
///
/// D(w) = 1 / (2 pi sqrt|S| (w^T S^-1 w)^2) = |S|^(3/2) / (2 pi (w^T adj(S) w)^2)
/// [Heitz15, eq. 10], halved: Heitz's D integrates to 2 with Heddle's scale of S (docs/sggx.md).
///
/// @param S  positive definite, scaled as SymmetricMatrix says (else the integral is not 1)
/// @param w  unit
/// @return   > 0; 0 where S is not definite
[[nodiscard]] HEDDLE_HD inline float ndf(const SggxMatrix& S, Vec3f w) {
    const double a = S.xx;
    const double b = S.yy;
    const double c = S.zz;
    const double d = S.xy;
    const double e = S.xz;
    const double f = S.yz;
    const Vec3d v = to_double(w);
    const Vec3d adjugate_v{(b * c - f * f) * v.x + (e * f - d * c) * v.y + (d * f - e * b) * v.z,
                           (e * f - d * c) * v.x + (a * c - e * e) * v.y + (d * e - a * f) * v.z,
                           (d * f - e * b) * v.x + (d * e - a * f) * v.y + (a * b - d * d) * v.z};
    const double determinant = a * (b * c - f * f) + d * (e * f - d * c) + e * (d * f - e * b);
    const double q = dot(v, adjugate_v);
    if (!(determinant > 0.0) || !(q > 0.0)) return 0.0f;
    return static_cast<float>(0.15915494309189535 * determinant * std::sqrt(determinant) / (q * q));
}

/// The part of S that sampling needs: columns of a matrix A with A A^T = S, and their lengths.
struct SggxFactor {
    Vec3f column[3]{};
    float reach[3]{};
};

/// The Cholesky factor of `S`; columns that rounding would make imaginary are 0.
///
/// @param S  positive semi-definite, any scale
[[nodiscard]] HEDDLE_HD inline SggxFactor factor(const SggxMatrix& S) {
    const auto root = [](float x) { return std::sqrt(x > 0.0f ? x : 0.0f); };
    const auto divide = [](float x, float y) { return y > 0.0f ? x / y : 0.0f; };
    SggxFactor A;
    Vec3f& x = A.column[0];
    Vec3f& y = A.column[1];
    Vec3f& z = A.column[2];
    x.x = root(S.xx);
    x.y = divide(S.xy, x.x);
    x.z = divide(S.xz, x.x);
    y.y = root(S.yy - x.y * x.y);
    y.z = divide(S.yz - x.y * x.z, y.y);
    z.z = root(S.zz - x.z * x.z - y.z * y.z);
    for (int i = 0; i < 3; ++i) A.reach[i] = length(A.column[i]);
    return A;
}

/// Draws a direction with density ndf(S) over the whole sphere, from the factor of S.
///
/// A u / |A u| has density D if u on the sphere has density ~ |A u|; no map of two uniform numbers
/// has that density in closed form (its integral is elliptic). So u is drawn from the mixture sum_j
/// reach_j |u_j|, a cosine lobe about each axis, and accepted with probability |A u| / sum_j
/// reach_j |u_j|: at least 1 / 3, 2 / 3 for a sphere, 1 for a needle. The whole sphere, as in
/// [Fabre26, 4.1]; only + - * / sqrt.
///
/// @param A       factor(S)
/// @param random  with next(): 64 uniform bits; two draws per try
/// @return        unit
template <typename Random>
[[nodiscard]] HEDDLE_HD inline Vec3f sample_ndf(const SggxFactor& A, Random& random) {
    const float sum = A.reach[0] + A.reach[1] + A.reach[2];
    constexpr int kTries = 128; // all fail with probability below 1e-16
    for (int i = 0; i < kTries; ++i) {
        const std::uint64_t point = random.next();
        const std::uint64_t choice = random.next();
        const float p = 2.0f * to_unit_float(point) - 1.0f;
        const float q = 2.0f * to_unit_float(point << 24) - 1.0f;
        const float rr = p * p + q * q;
        if (rr >= 1.0f) continue;
        const float height = std::sqrt(1.0f - rr); // the disc, projected up: density ~ height
        const float t = sum * to_unit_float(choice);
        const int axis = t < A.reach[0] ? 0 : t < A.reach[0] + A.reach[1] ? 1 : 2;
        const Vec3f u = axis == 0   ? Vec3f{height, p, q}
                        : axis == 1 ? Vec3f{q, height, p}
                                    : Vec3f{p, q, height};
        const Vec3f w = A.column[0] * u.x + A.column[1] * u.y + A.column[2] * u.z;
        const float bound =
            A.reach[0] * std::fabs(u.x) + A.reach[1] * std::fabs(u.y) + A.reach[2] * std::fabs(u.z);
        const float size = length(w);
        if (!(size > bound * to_unit_float(choice << 24))) continue;
        return w * ((point & 1) != 0 ? -1.0f / size : 1.0f / size);
    }
    return normalize(A.column[0]); // S = 0
}

/// The density of the normals that are visible from `wi`, per steradian over the whole sphere.
///
/// D_wi(w) = <w . wi> D(w) / (sigma(wi) / 2), where < > clamps at 0       [Heitz15]
///
/// @param S      positive definite, scaled as SymmetricMatrix says
/// @param wi, w  unit
[[nodiscard]] HEDDLE_HD inline float vndf(const SggxMatrix& S, Vec3f wi, Vec3f w) {
    const float cosine = dot(w, wi);
    return cosine > 0.0f ? 2.0f * cosine * ndf(S, w) / projected_area(S, wi) : 0.0f;
}

/// Draws a direction with density vndf(S, wi), from the factor of S: one draw, no rejection.
///
/// w = A u / |A u| has density D if u has density ~ |A u|; seen from wi, ~ |A u| <w . wi> = <u .
/// A^T wi>: a cosine lobe about A^T wi. It has the distribution of [Heitz15].
///
/// @param A   factor(S)
/// @param wi  unit
/// @return    unit, on the side of wi
template <typename Random>
[[nodiscard]] HEDDLE_HD inline Vec3f sample_vndf(const SggxFactor& A, Vec3f wi, Random& random) {
    const Vec3f v =
        normalize(Vec3f{dot(A.column[0], wi), dot(A.column[1], wi), dot(A.column[2], wi)});
    const Vec3f p = any_perpendicular(v);
    const Vec3f q = cross(v, p);
    const std::uint64_t draw = random.next();
    const float square = to_unit_float(draw); // square of the distance from the lobe's axis
    const SinCos turn = sincos_turns(static_cast<double>(to_unit_float(draw << 24)));
    const Vec3f u =
        (p * turn.cos + q * turn.sin) * std::sqrt(square) + v * std::sqrt(1.0f - square);
    return normalize(A.column[0] * u.x + A.column[1] * u.y + A.column[2] * u.z, wi);
}

} // namespace heddle
