#pragma once

#include <heddle/voxel/leaf_voxels.h>
#include <heddle/voxelize/voxelize.h>

#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

// Voxelizes small geometries for tests and the tables of bench/.

namespace heddle::test {

/// A geometry of these curves and one fiber material.
inline Geometry geometry_of(CurveSet set) {
    Geometry geometry;
    geometry.name = "test";
    Material fiber;
    fiber.name = "fiber";
    fiber.kind = MaterialKind::Fiber;
    geometry.materials.push_back(fiber);
    geometry.curves.push_back(std::move(set));
    return geometry;
}

/// Adds a curve through `points`, open unless `closed`.
inline void add_curve(CurveSet& set, const std::vector<Vec3f>& points, bool closed = false) {
    if (set.first.empty()) set.first.push_back(0);
    set.points.insert(set.points.end(), points.begin(), points.end());
    set.first.push_back(set.points.size());
    set.closed.push_back(closed ? 1 : 0);
}

inline std::unique_ptr<VoxelLevel> voxelize_now(const Geometry& geometry,
                                                const VoxelizeOptions& options) {
    Progress silent;
    return voxelize(geometry, options, plan_voxelize(geometry, options), silent);
}

/// Coverage along an axis, in [0, 1].
inline double covered(const Coverage& coverage, int axis) {
    const std::uint16_t c = axis == 0 ? coverage.x : axis == 1 ? coverage.y : coverage.z;
    return c / 65535.0;
}

/// Occupied volume, scene units^3.
inline double occupied_volume(const VoxelLevel& source) {
    double sum = 0.0;
    for_each_voxel(source, [&](const BlockVoxel& v) { sum += v.coverage().occupancy / 65535.0; });
    const Vec3d h = source.info().lattice.voxel_size;
    return sum * h.x * h.y * h.z;
}

} // namespace heddle::test
