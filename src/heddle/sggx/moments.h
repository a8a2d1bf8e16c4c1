#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>
#include <heddle/sggx/eigen.h>
#include <heddle/sggx/moment_table.h>
#include <heddle/sggx/sggx.h>

#include <cmath>

namespace heddle {

/// The smallest sigma along an eigenvector that a fit returns: half a step of the packed sigma,
/// hence the smallest that still rounds to a byte above 0. An aligned bundle then keeps M to 5e-5,
/// and S stays positive definite in float (its eigenvalue 3.8e-6 is 60 times an entry's rounding).
inline constexpr float kMinSigma = 1.0f / 510.0f;

namespace detail {

/// Second moment along the three eigenvectors of an SGGX, trace 1.
///
/// M_i ~ a_i (P_j + P_k), P_i = a_i R_D(a_j, a_k, a_i)                              [docs/sggx.md]
/// R_D by duplication [Carlson 1995]; all three share one sequence. Five steps leave an error of
/// 7e-9 at any ratio down to 0; each step divides the error by 60.
/// @param kSteps  number of duplications
/// @param a  eigenvalues of S in any scale; the first is the largest and > 0
template <int kSteps = 5>
[[nodiscard]] HEDDLE_HD inline Vec3d moment_of_eigenvalues(Vec3d a) {
    const double floor = 1e-16 * a.x; // zero eigenvalue: P is 0 in the limit, not 0 x infinity
    a.y = a.y > floor ? a.y : floor;
    a.z = a.z > floor ? a.z : floor;
    Vec3d b = a;
    Vec3d integral{}; // R_D / 3
    double weight = 1.0;
    for (int step = 0; step < kSteps; ++step) {
        const Vec3d root{std::sqrt(b.x), std::sqrt(b.y), std::sqrt(b.z)};
        const double lambda = root.x * (root.y + root.z) + root.y * root.z;
        const Vec3d next{b.x + lambda, b.y + lambda, b.z + lambda};
        const Vec3d below = root * next; // one division for the three terms weight / below
        const double yz = below.y * below.z;
        const double scale = weight / (below.x * yz);
        integral = integral + Vec3d{yz, below.x * below.z, below.x * below.y} * scale;
        b = next * 0.25;
        weight *= 0.25;
    }
    // nearly equal now: R_D / 3 of the three means (b_i weighs three times), to first order
    const double mean = (b.x + b.y + b.z) * (1.0 / 3.0);
    const double inverse = 1.0 / mean;
    const double rest = weight * inverse / (3.0 * std::sqrt(mean));
    const Vec3d first{1.6 - 0.6 * inverse * b.x, 1.6 - 0.6 * inverse * b.y,
                      1.6 - 0.6 * inverse * b.z};
    const Vec3d P = a * (integral + first * rest);
    const Vec3d M = a * Vec3d{P.y + P.z, P.x + P.z, P.x + P.y};
    return M * (1.0 / (M.x + M.y + M.z));
}

/// Weights of the values at the nodes -1, 0, 1 and 2.
struct CubicWeights {
    float a, b, c, d;
};

/// The weights that evaluate the cubic through four nodes at `f`.
[[nodiscard]] HEDDLE_HD constexpr CubicWeights cubic_weights(float f) {
    const float a = f + 1.0f;
    const float c = f - 1.0f;
    const float d = f - 2.0f;
    return {f * c * d * (-1.0f / 6.0f), a * c * d * 0.5f, a * f * d * -0.5f,
            a * f * c * (1.0f / 6.0f)};
}

/// Interpolates the table along v in one row of nodes.
[[nodiscard]] HEDDLE_HD inline Vec3f interpolate_row(const float* node, CubicWeights w) {
    return {(w.a * node[0] + w.b * node[4]) + (w.c * node[8] + w.d * node[12]),
            (w.a * node[1] + w.b * node[5]) + (w.c * node[9] + w.d * node[13]),
            (w.a * node[2] + w.b * node[6]) + (w.c * node[10] + w.d * node[14])};
}

[[nodiscard]] HEDDLE_HD constexpr float clamp(float x, float low, float high) {
    return x > low ? (x < high ? x : high) : low; // NaN gives low
}

/// The first of the four nodes around `x`, clamped to a table of `count` nodes.
[[nodiscard]] HEDDLE_HD inline int first_node(float x, int count) {
    const int i = static_cast<int>(x) - 1;
    return i < 0 ? 0 : i > count - 4 ? count - 4 : i;
}

/// The three sigmas of the SGGX whose second moment has eigenvalues `m`, without the lower bound.
///
/// @param m  descending, the first > 0; any scale
[[nodiscard]] HEDDLE_HD inline Vec3f sigma_of_moment(Vec3d m) {
    const float y_of_x = static_cast<float>(m.y / m.x);
    const float z_of_y = m.y > 0.0 ? static_cast<float>(m.z / m.y) : 1.0f;
    // u^4 = m_y / m_x, v^2 = m_z / m_y: coordinates in which the inverse is smooth
    constexpr float kMinRatio = kTableMinU * kTableMinU * kTableMinU * kTableMinU;
    const float u = std::sqrt(std::sqrt(clamp(y_of_x, kMinRatio, 1.0f)));
    const float v = std::sqrt(clamp(z_of_y, 0.0f, 1.0f));

    const float x = u * kTableStepsU - 1.0f;
    const float y = v * kTableStepsV;
    const int i = first_node(x, kTableCountU);
    const int j = first_node(y, kTableCountV);
    const CubicWeights along_u = cubic_weights(x - static_cast<float>(i + 1));
    const CubicWeights along_v = cubic_weights(y - static_cast<float>(j + 1));
    const float* node = moment_table_node(i, j);
    constexpr int kRow = 4 * kTableCountV;
    // unrolled: -O2 keeps short loops as loops, which takes twice the time
    const Vec3f g = (interpolate_row(node, along_v) * along_u.a +
                     interpolate_row(node + kRow, along_v) * along_u.b) +
                    (interpolate_row(node + 2 * kRow, along_v) * along_u.c +
                     interpolate_row(node + 3 * kRow, along_v) * along_u.d);
    return {g.x, g.y * (u * u), g.z * (u * u * v)};
}

} // namespace detail

/// Second moment M(S) = integral of w w^T D(w) over the sphere, for the SGGX of matrix `S`.
///
/// M has the eigenvectors of S; its eigenvalues are complete elliptic integrals of S's
/// (docs/sggx.md), here to a float's rounding.
/// @param S  positive semi-definite, entries finite, not 0; its scale does not matter
/// @param kSteps  as in detail::moment_of_eigenvalues
/// @return   trace 1
template <int kSteps = 5>
[[nodiscard]] HEDDLE_HD inline SymmetricMatrix second_moment_of(const SggxMatrix& S) {
    const SymmetricEigen e = decompose(S);
    const Vec3d m = detail::moment_of_eigenvalues<kSteps>({e.value[0], e.value[1], e.value[2]});
    return compose({{m.x, m.y, m.z}, {e.axis[0], e.axis[1], e.axis[2]}});
}

/// The second moment of the normals of thin cylinders whose tangents have the second moment `M`.
/// @param M  trace 1
/// @return   trace 1
[[nodiscard]] HEDDLE_HD inline SymmetricMatrix moment_of_normals(const SymmetricMatrix& M) {
    return {0.5f * (1.0f - M.xx), 0.5f * (1.0f - M.yy), 0.5f * (1.0f - M.zz),
            -0.5f * M.xy,         -0.5f * M.xz,         -0.5f * M.yz};
}

/// The SGGX whose own second moment is `M`: the inverse of second_moment_of, to 1e-5 in M.
///
/// It is unique: M is the gradient of a convex function of log sigma (docs/sggx.md). No sigma falls
/// below kMinSigma, which costs at most 5e-5 in M.
/// @param M  positive semi-definite, entries finite; any scale (a sum of weights w w^T)
/// @return   S, normalized as SymmetricMatrix says; the uniform SGGX where the trace is not > 0
[[nodiscard]] HEDDLE_HD inline SggxMatrix fit_sggx(const SymmetricMatrix& M) {
    const SymmetricEigen e = decompose(M);
    if (!(e.value[0] > 0.0)) return {0.25f, 0.25f, 0.25f, 0.0f, 0.0f, 0.0f};
    const Vec3f sigma = detail::sigma_of_moment({e.value[0], e.value[1], e.value[2]});
    const Vec3d bounded =
        to_double({detail::clamp(sigma.x, kMinSigma, 1.0f), detail::clamp(sigma.y, kMinSigma, 1.0f),
                   detail::clamp(sigma.z, kMinSigma, 1.0f)});
    const Vec3d square = bounded * bounded;
    return compose({{square.x, square.y, square.z}, {e.axis[0], e.axis[1], e.axis[2]}});
}

} // namespace heddle
