#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>
#include <heddle/sggx/eigen.h>
#include <heddle/sggx/pack.h>

#include <cmath>
#include <cstdint>

namespace heddle {

/// Two planes of a voxel, perpendicular to the normal of its first lobe. All surfaces of that lobe
/// lie between them.                                          [Laine10, contours of sparse octrees]
///
/// Value v is the plane at (v / 255 * 2 - 1) s along the unit normal n (slab_normal), measured from
/// the voxel's centre. s is half of the voxel's extent along n, 0.5 sum over the axes |n_a| h_a,
/// where h are the voxel's edges. So 0 and 255 are the planes through the outermost corners.
///
/// Both are rounded to the nearest plane: a single plane has lo == hi, and a surface may be outside
/// by half a step. Lengths are in scene units. In units of the voxel's edges the same values come
/// from slab_gradient(), which contains h.
struct PlaneSlab {
    std::uint8_t lo = 0;   ///< <= hi
    std::uint8_t hi = 255; ///< {0, 255} says nothing, as where the first lobe is of fibers
    friend bool operator==(const PlaneSlab&, const PlaneSlab&) = default;
};
static_assert(sizeof(PlaneSlab) == 2, "two bytes in files");

/// Returns the normal that a slab of a voxel refers to, from the S of its first lobe as stored.
/// @return  unit to 1e-9; its component of largest magnitude is positive (eigen.h). It is never
///          rounded to floats: gcc 12 leaves such a rounding out where it vectorizes, and the bits
///          would depend on the caller
[[nodiscard]] HEDDLE_HD inline Vec3d slab_normal(const PackedSggx& first_lobe) {
    return principal_axis(unpack(first_lobe));
}

/// Returns half of a voxel's extent along `normal`.
/// @param edges  of the voxel; the result has their unit
[[nodiscard]] HEDDLE_HD inline double slab_half_extent(Vec3d normal, Vec3d edges) {
    return 0.5 * (std::fabs(normal.x) * edges.x + std::fabs(normal.y) * edges.y +
                  std::fabs(normal.z) * edges.z);
}

/// Returns the plane of value v along the normal, measured from the voxel's centre.
/// @param half_extent  slab_half_extent(); the result has its unit
[[nodiscard]] HEDDLE_HD inline double slab_position(std::uint8_t v, double half_extent) {
    return (static_cast<double>(v) / 255.0 * 2.0 - 1.0) * half_extent;
}

/// Returns the change of a slab's value along each edge of the voxel: the value at a point is
/// slab_value(gradient, p) and lies in [0, 255] inside the voxel.
/// @param edges  of the voxel, in any unit: only their ratios count
[[nodiscard]] HEDDLE_HD inline Vec3d slab_gradient(Vec3d normal, Vec3d edges) {
    return normal * edges * (127.5 / slab_half_extent(normal, edges));
}

/// Returns the unrounded value of a slab's plane through a point.
/// @param from_center  the point relative to the voxel's centre, in units of the voxel's edges:
///                     -0.5 to 0.5 inside
[[nodiscard]] HEDDLE_HD inline double slab_value(Vec3d gradient, Vec3d from_center) {
    return 127.5 + dot(gradient, from_center);
}

/// Rounds a value to the nearest plane that can be stored.
[[nodiscard]] HEDDLE_HD inline std::uint8_t round_slab_value(double value) {
    const double x = value + 0.5;
    return static_cast<std::uint8_t>(x > 0.0 ? (x < 255.0 ? x : 255.0) : 0.0);
}

} // namespace heddle
