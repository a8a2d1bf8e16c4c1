#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>
#include <heddle/yarn/cubic.h>
#include <heddle/yarn/fiber_view.h>

namespace heddle {

/// Returns a unit vector perpendicular to the unit vector `t`, within single precision.
[[nodiscard]] HEDDLE_HD inline Vec3d any_perpendicular(Vec3d t) {
    return to_double(any_perpendicular(to_float(t)));
}

/// A yarn's cross-section at one point of a piece. The voxelizer uses it in units and single
/// precision, traced fibers use it in scene units and double precision.
/// @tparam T  float or double
template <typename T>
struct YarnSection {
    Vec3<T> center, normal, binormal; ///< the last two are unit vectors across the yarn
    T scale;                          ///< units per model unit
    double s;                         ///< yarn length since its start, model units

    /// @param cubic  the piece's centreline
    /// @param t      parameter of the piece, in [0, 1]
    HEDDLE_HD YarnSection(const PowerCubic<T>& cubic, const YarnCourse& course, T t) {
        const Vec3<T> tangent = normalize(cubic.derivative(t));
        const Vec3f &n0 = course.normal0, &n1 = course.normal1;
        const Vec3<T> lerped =
            Vec3<T>{n0.x, n0.y, n0.z} * (T(1) - t) + Vec3<T>{n1.x, n1.y, n1.z} * t;
        normal = normalize(lerped - dot(lerped, tangent) * tangent, any_perpendicular(tangent));
        binormal = cross(tangent, normal);
        center = cubic.at(t);
        scale = static_cast<T>(course.scale0) * (T(1) - t) + static_cast<T>(course.scale1) * t;
        s = course.start + course.length * static_cast<double>(t);
    }
};

} // namespace heddle
