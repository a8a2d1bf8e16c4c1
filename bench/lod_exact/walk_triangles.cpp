#include "directions.h"

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/base/random.h>
#include <heddle/surface/surface_source.h>
#include <heddle/voxel/lattice_units.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace heddle::bench {
namespace {

constexpr double kBatch = 2e6; ///< approximate number of points

struct TriangleId {
    std::uint32_t mesh;
    std::uint32_t triangle;
    double area;
};

std::vector<TriangleId> list_triangles(const Geometry& geometry) {
    std::vector<TriangleId> list;
    for (std::uint32_t m = 0; m < geometry.meshes.size(); ++m) {
        const Mesh& mesh = geometry.meshes[m];
        for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
            const auto& [a, b, c] = mesh.triangles[i];
            const Vec3d p = to_double(mesh.positions[a]);
            const double area = 0.5 * length(cross(to_double(mesh.positions[b]) - p,
                                                   to_double(mesh.positions[c]) - p));
            if (area > 0.0) list.push_back({m, i, area});
        }
    }
    return list;
}

/// Barycentric coordinates of point `i` of the R2 sequence [Roberts 2018], shifted at random and
/// folded onto the triangle.
Vec3d point_on(std::uint64_t id, std::int64_t i) {
    const auto n = static_cast<double>(i) + 1.0;
    double u = static_cast<double>(to_unit_float(hash64(17, id, 0))) + 0.7548776662466927 * n;
    double v = static_cast<double>(to_unit_float(hash64(17, id, 1))) + 0.5698402909980532 * n;
    u -= std::floor(u);
    v -= std::floor(v);
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    return {1.0 - u - v, u, v};
}

struct Surfaces {
    const Geometry& geometry;
    SurfaceSource source;
    Vec3d voxel_size;
    double point_area;

    void walk(const TriangleId& id, std::vector<Directed>& out) const {
        const Mesh& mesh = geometry.meshes[id.mesh];
        const TriangleSetup setup =
            set_up_triangle(source.view(), source.view_of(mesh), id.triangle);
        const auto& [a, b, c] = mesh.triangles[id.triangle];
        const auto count = static_cast<std::int64_t>(std::ceil(id.area / point_area));
        const auto weight = static_cast<float>(id.area / static_cast<double>(count));
        const std::uint64_t number = std::uint64_t{id.mesh} << 32 | id.triangle;
        for (std::int64_t i = 0; i < count; ++i) {
            const Vec3d w = point_on(number, i);
            // the index seeds the sampler's random footprint point: different for every point
            const SurfaceHit hit{static_cast<std::int32_t>(id.mesh % 3),
                                 static_cast<std::int32_t>(id.triangle),
                                 static_cast<std::int32_t>(i),
                                 static_cast<std::int32_t>(id.mesh),
                                 static_cast<float>(w.x),
                                 static_cast<float>(w.y),
                                 static_cast<float>(w.z)};
            const SurfaceSample s = sample_at(source.view().seed, setup, hit);
            if (!s.covered) continue;
            const Vec3d p = w.x * to_double(mesh.positions[a]) +
                            w.y * to_double(mesh.positions[b]) + w.z * to_double(mesh.positions[c]);
            Vec3i voxel;
            for (int k = 0; k < 3; ++k) {
                voxel[k] = static_cast<std::int32_t>(std::floor(p[k] / voxel_size[k]));
            }
            out.push_back({voxel, s.normal, weight});
            const float strong = weight * s.anisotropy;
            if (setup.maps->anisotropic && strong > 0.0f) {
                out.push_back({voxel, s.tangent, strong, Kind::Tangent});
            }
        }
    }
};

} // namespace

void walk_triangles(const Geometry& geometry,
                    const Lattice& lattice,
                    double spacing,
                    const TakeDirections& take) {
    const double edge = spacing * LatticeUnits(lattice).unit;
    constexpr std::uint64_t kSeed = 71; // different from the voxelizer's
    const Surfaces surfaces{geometry, SurfaceSource(geometry, {edge, edge, edge}, kSeed),
                            lattice.voxel_size, edge * edge};
    for (const Mesh& mesh : geometry.meshes) {
        if (surfaces.source.view_of(mesh).kind != SurfaceKind::Displaced) continue;
        throw Error(ErrorCode::Unsupported, "a displaced surface", "walk plain ones");
    }
    const std::vector<TriangleId> list = list_triangles(geometry);
    for (std::size_t begin = 0; begin < list.size();) {
        std::size_t end = begin;
        for (double size = 0.0; end < list.size() && size < kBatch; ++end) {
            size += 1.0 + list[end].area / surfaces.point_area;
        }
        const std::vector<Directed> batch = reduce_chunks(
            end - begin, std::max<std::size_t>(1, (end - begin) / 64), std::vector<Directed>(),
            [&](std::size_t b, std::size_t e) {
                std::vector<Directed> out;
                for (std::size_t i = b; i < e; ++i) surfaces.walk(list[begin + i], out);
                return out;
            },
            [](std::vector<Directed> a, const std::vector<Directed>& b) {
                a.insert(a.end(), b.begin(), b.end());
                return a;
            });
        take(batch);
        begin = end;
    }
}

} // namespace heddle::bench
