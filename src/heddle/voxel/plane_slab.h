#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>
#include <heddle/sggx/eigen.h>

#include <cmath>
#include <cstdint>

namespace heddle {

/// A direction without a sign in two bytes: the octahedron's projection of the upper half of the
/// sphere, turned by 45 degrees. The axes are exact, other directions within 0.6 degrees.
struct PackedNormal {
    std::uint8_t u = 127; ///< 127 is 0; 0 to 254
    std::uint8_t v = 127;
    friend bool operator==(const PackedNormal&, const PackedNormal&) = default;
};

[[nodiscard]] HEDDLE_HD inline PackedNormal pack_normal(Vec3d n) {
    const double sum = std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z);
    const double k = (n.z < 0.0 ? -1.0 : 1.0) / (sum > 0.0 ? sum : 1.0);
    const double x = n.x * k;
    const double y = n.y * k;
    return {static_cast<std::uint8_t>((x + y) * 127.0 + 127.5),
            static_cast<std::uint8_t>((x - y) * 127.0 + 127.5)};
}

/// @return  unit; z >= 0
[[nodiscard]] HEDDLE_HD inline Vec3d unpack_normal(PackedNormal p) {
    const double u = (static_cast<double>(p.u) - 127.0) / 127.0;
    const double v = (static_cast<double>(p.v) - 127.0) / 127.0;
    const double x = 0.5 * (u + v);
    const double y = 0.5 * (u - v);
    const double z = 1.0 - std::fabs(x) - std::fabs(y);
    return normalize(Vec3d{x, y, z > 0.0 ? z : 0.0});
}

/// Two planes of a voxel, perpendicular to the main normal of its surfaces. All surfaces of its
/// first lobe lie between them.                             [Laine10, contours of sparse octrees]
///
/// The normal is the principal direction of the second moment of the triangles' own normals, by
/// area: normals that are interpolated or mapped for shading do not bend it.
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
    PackedNormal normal{};
    friend bool operator==(const PlaneSlab&, const PlaneSlab&) = default;
};
static_assert(sizeof(PlaneSlab) == 4, "four bytes in files");

/// Returns the normal of a slab.
/// @return  unit, to the rounding of a double
[[nodiscard]] HEDDLE_HD inline Vec3d slab_normal(const PlaneSlab& slab) {
    return unpack_normal(slab.normal);
}

/// Returns the areas of a voxel's faces, of which the largest is 1.
[[nodiscard]] HEDDLE_HD inline Vec3d slab_faces(Vec3d edges) {
    const Vec3d faces{edges.y * edges.z, edges.z * edges.x, edges.x * edges.y};
    const double xy = faces.x > faces.y ? faces.x : faces.y;
    return faces * (1.0 / (xy > faces.z ? xy : faces.z));
}

/// Adds the second moment of a normal, weighted by area.
/// @param area  vector area in units of slab_faces()
HEDDLE_HD inline void add_area_moment(Vec3d area, std::int64_t (&moment)[6]) {
    const double size = length(area);
    if (!(size > 0.0)) return;
    const double k = 1073741824.0 / size; // 2^30: a thousandth of a subvoxel's face counts
    const auto add = [&](int i, double x) { moment[i] += static_cast<std::int64_t>(x * k); };
    add(0, area.x * area.x), add(1, area.y * area.y), add(2, area.z * area.z);
    add(3, area.x * area.y), add(4, area.x * area.z), add(5, area.y * area.z);
}

[[nodiscard]] HEDDLE_HD inline PackedNormal main_normal(const std::int64_t (&m)[6]) {
    const auto at = [&](int i) { return static_cast<float>(m[i]); };
    return pack_normal(to_double(principal_direction({at(0), at(1), at(2), at(3), at(4), at(5)})));
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
