// A plug-in like those of modelling programs: a C interface with heddle behind it.
#include <heddle/heddle.h>

#include <cstdint>
#include <cstdio>

namespace {

std::int64_t count_voxels(const heddle::Geometry& geometry, std::int64_t voxels) {
    heddle::VoxelizeOptions options;
    options.voxels = voxels;
    heddle::Progress progress;
    const heddle::VoxelizePlan plan = heddle::plan_voxelize(geometry, options, progress);
    return heddle::voxelize(geometry, options, plan, progress)->info().voxel_count;
}

} // namespace

/// Voxelizes a polyline.
/// @param points  three numbers per point
/// @param voxels  along the longest axis
/// @return        the number of voxels; -1: it failed, and `message` has the reason
extern "C" [[gnu::visibility("default")]] std::int64_t voxelize_polyline(const float* points,
                                                                         std::int64_t point_count,
                                                                         float radius,
                                                                         std::int64_t voxels,
                                                                         char* message,
                                                                         std::size_t message_size) {
    try {
        heddle::Geometry geometry;
        geometry.materials.push_back({.name = "thread", .kind = heddle::MaterialKind::Fiber});
        heddle::CurveSet& set = geometry.curves.emplace_back();
        set.basis = heddle::Basis::Linear;
        set.default_radius = radius;
        set.first = {0, static_cast<std::uint64_t>(point_count)};
        for (std::int64_t i = 0; i < point_count; ++i, points += 3) {
            set.points.push_back({points[0], points[1], points[2]});
        }
        return count_voxels(geometry, voxels);
    } catch (const std::exception& error) { // no exception may leave a C function
        std::snprintf(message, message_size, "%s", error.what());
        return -1;
    }
}
