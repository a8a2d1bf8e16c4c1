#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>
#include <heddle/sggx/sggx.h>

#include <cmath>

namespace heddle {

/// Eigenvalues of a symmetric matrix, largest first, with their right-handed unit axes.
struct SymmetricEigen {
    double value[3]{};
    Vec3d axis[3]{};
};

namespace detail {

/// A symmetric 3x3 matrix in double, with the entries of SymmetricMatrix: products of floats are
/// exact in it, so no scaling is needed for the smallest or largest float entries.
struct SymmetricMatrixd {
    double xx, yy, zz, xy, xz, yz;
};

[[nodiscard]] HEDDLE_HD inline Vec3d multiply(const SymmetricMatrixd& A, Vec3d w) {
    return {A.xx * w.x + A.xy * w.y + A.xz * w.z, A.xy * w.x + A.yy * w.y + A.yz * w.z,
            A.xz * w.x + A.yz * w.y + A.zz * w.z};
}

/// The largest root of t^3 - 3t - 2h, which lies in [sqrt 3, 2], to 2e-10.
///
/// Uses a quartic through the root's Chebyshev-Lobatto nodes (error < 1.6e-5) and one Newton step,
/// which leaves 3/4 of the squared error. The eigenvector below needs no more, and the eigenvalue
/// is computed again from it.
/// @param h  in [0, 1]
[[nodiscard]] HEDDLE_HD inline double largest_cubic_root(double h) {
    const double t =
        (1.7320508075688774 + 0.33300567068545767 * h) +
        h * h * (-0.0923901384831591 + h * (0.03553247226717883 - 0.008198812038354807 * h));
    return t - (t * (t * t - 3.0) - 2.0 * h) / (3.0 * (t * t - 1.0));
}

/// The unit null vector of a matrix of rank 2: the largest column of its adjugate.
[[nodiscard]] HEDDLE_HD inline Vec3d null_vector(const SymmetricMatrixd& C) {
    const double xx = C.yy * C.zz - C.yz * C.yz;
    const double yy = C.xx * C.zz - C.xz * C.xz;
    const double zz = C.xx * C.yy - C.xy * C.xy;
    const double xy = C.xz * C.yz - C.xy * C.zz;
    const double xz = C.xy * C.yz - C.xz * C.yy;
    const double yz = C.xy * C.xz - C.yz * C.xx;
    // the adjugate is a positive multiple of v v^T: its largest diagonal entry selects the column
    const Vec3d v = (xx >= yy && xx >= zz) ? Vec3d{xx, xy, xz}
                    : (yy >= zz)           ? Vec3d{xy, yy, yz}
                                           : Vec3d{xz, yz, zz};
    return normalize(v);
}

/// Splits the plane perpendicular to the eigenvector `v` into its two eigenvectors.
///
/// @return  [0] (larger) and [1]: axes and values of the plane; [2] is `v`
[[nodiscard]] HEDDLE_HD inline SymmetricEigen decompose_plane(const SymmetricMatrixd& A, Vec3d v) {
    const double sign = v.z < 0.0 ? -1.0 : 1.0; // [Duff 2017], as in any_perpendicular
    const double k = -1.0 / (sign + v.z);
    const Vec3d p{1.0 + sign * v.x * v.x * k, sign * v.x * v.y * k, -sign * v.x};
    const Vec3d q = cross(v, p);
    const Vec3d Ap = multiply(A, p);
    const double pp = dot(p, Ap);
    const double qq = dot(q, multiply(A, q));
    const double pq = dot(q, Ap);

    const double half = 0.5 * (pp - qq);
    const double radius = std::sqrt(half * half + pq * pq);
    double c = 1.0;
    double s = 0.0;
    if (radius > 0.0) { // the first component is the sum that does not cancel
        c = half >= 0.0 ? radius + half : pq;
        s = half >= 0.0 ? pq : radius - half;
        const double scale = 1.0 / std::sqrt(c * c + s * s);
        c *= scale;
        s *= scale;
    }
    const double mean = 0.5 * (pp + qq);
    return {{mean + radius, mean - radius, dot(v, multiply(A, v))},
            {p * c + q * s, q * c - p * s, v}};
}

/// An eigenvector, and whether its eigenvalue is the largest or the smallest.
struct SeparatedAxis {
    Vec3d axis;           ///< unit; zero where all three are equal
    bool largest = false; ///< else the smallest
};

/// The eigenvector whose eigenvalue is farthest from the other two.                   [Eberly 2014]
[[nodiscard]] HEDDLE_HD inline SeparatedAxis find_separated_axis(const SymmetricMatrixd& M) {
    const double mean = (M.xx + M.yy + M.zz) * (1.0 / 3.0);
    SymmetricMatrixd B{M.xx - mean, M.yy - mean, M.zz - mean, M.xy, M.xz, M.yz};
    const double square =
        (B.xx * B.xx + B.yy * B.yy + B.zz * B.zz) + 2.0 * (B.xy * B.xy + B.xz * B.xz + B.yz * B.yz);
    if (!(square > 0.0)) return {};
    const double scale = 1.0 / std::sqrt(square * (1.0 / 6.0)); // eigenvalues now in [-2, 2]
    B = {B.xx * scale, B.yy * scale, B.zz * scale, B.xy * scale, B.xz * scale, B.yz * scale};
    const double determinant = B.xx * (B.yy * B.zz - B.yz * B.yz) -
                               B.xy * (B.xy * B.zz - B.yz * B.xz) +
                               B.xz * (B.xy * B.yz - B.yy * B.xz);
    const double h = 0.5 * (determinant < 0.0 ? -determinant : determinant);
    const double t = largest_cubic_root(h < 1.0 ? h : 1.0);
    const double root = determinant < 0.0 ? -t : t;
    return {null_vector({B.xx - root, B.yy - root, B.zz - root, B.xy, B.xz, B.yz}),
            !(determinant < 0.0)};
}

[[nodiscard]] HEDDLE_HD inline SymmetricMatrixd to_double(const SymmetricMatrix& A) {
    return {A.xx, A.yy, A.zz, A.xy, A.xz, A.yz};
}

} // namespace detail

/// Eigenvalues and axes of `A`, with + - * / sqrt only: the same bits on host and device.
///
/// The root of the characteristic cubic that is apart from the others is found first, and its axis,
/// which is well conditioned for any other two; these are then exact in the plane that is left.
/// Repeated and zero eigenvalues are no special case.                                 [Eberly 2014]
///
/// @param A  entries finite
/// @return   values descending; axes orthonormal to 1e-9, arbitrary where values are equal
[[nodiscard]] HEDDLE_HD inline SymmetricEigen decompose(const SymmetricMatrix& A) {
    const detail::SymmetricMatrixd M = detail::to_double(A);
    const detail::SeparatedAxis apart = detail::find_separated_axis(M);
    if (apart.axis == Vec3d{}) {
        const double mean = (M.xx + M.yy + M.zz) * (1.0 / 3.0);
        return {{mean, mean, mean}, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    }
    const SymmetricEigen e = detail::decompose_plane(M, apart.axis);
    if (!apart.largest) return e;
    return {{e.value[2], e.value[0], e.value[1]}, {e.axis[2], e.axis[0], e.axis[1]}};
}

/// sum over i of value_i axis_i axis_i^T, rounded once to float.
[[nodiscard]] HEDDLE_HD inline SymmetricMatrix compose(const SymmetricEigen& e) {
    const Vec3d a = e.axis[0] * e.value[0];
    const Vec3d b = e.axis[1] * e.value[1];
    const Vec3d c = e.axis[2] * e.value[2];
    const Vec3d x = e.axis[0];
    const Vec3d y = e.axis[1];
    const Vec3d z = e.axis[2];
    return {static_cast<float>(a.x * x.x + b.x * y.x + c.x * z.x),
            static_cast<float>(a.y * x.y + b.y * y.y + c.y * z.y),
            static_cast<float>(a.z * x.z + b.z * y.z + c.z * z.z),
            static_cast<float>(a.x * x.y + b.x * y.y + c.x * z.y),
            static_cast<float>(a.x * x.z + b.x * y.z + c.x * z.z),
            static_cast<float>(a.y * x.z + b.y * y.z + c.y * z.z)};
}

/// The unit eigenvector of the largest eigenvalue: an axial mean direction.
///
/// @param M  a second moment (or an S); entries finite
/// @return   its component of largest magnitude is positive (the first of equals); the x axis where
///           all eigenvalues are equal
[[nodiscard]] HEDDLE_HD inline Vec3d principal_axis(const SymmetricMatrix& M) {
    const detail::SeparatedAxis apart = detail::find_separated_axis(detail::to_double(M));
    const Vec3d d = apart.largest ? apart.axis : decompose(M).axis[0]; // no plane needed
    const Vec3d size{std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)};
    const double lead = (size.x >= size.y && size.x >= size.z) ? d.x : size.y >= size.z ? d.y : d.z;
    return lead < 0.0 ? d * -1.0 : d;
}

/// The same, rounded to floats.
[[nodiscard]] HEDDLE_HD inline Vec3f principal_direction(const SymmetricMatrix& M) {
    return to_float(principal_axis(M));
}

} // namespace heddle
