#include <heddle/voxel/gather_triangles.h>

#include <heddle/voxel/surface_hits.h>
#include <heddle/voxel/triangle_scan.h>

#include <algorithm>

namespace heddle {
namespace {

/// Neighbouring hits in a voxel that share a sample of the maps: a quarter of the cost of reading
/// them at each, and still 16 samples a voxel and axis.
constexpr int kMostRun = 4;

/// True only if the scan would find no hit in the box: half of what lies within reach of a block.
bool is_outside(const MicroTriangle& t, const SubvoxelBox& box) {
    bool outside = false;
    for (int a = 0; a < 3; ++a) { // a subvoxel more than the snapping can move a vertex
        const double lo = box.lo[a] - 1.0;
        const double hi = box.hi[a] + 1.0;
        const double x = t.p[0][a];
        const double y = t.p[1][a];
        const double z = t.p[2][a];
        outside |= (x < lo && y < lo && z < lo) || (x > hi && y > hi && z > hi);
    }
    return outside;
}

/// Adds a triangle that is not displaced.
template <typename Hits>
TriangleWork gather_flat(const BlockTriangle& t, Vec3d subvoxel_size) {
    const auto corner = [&](std::size_t v) {
        return to_lattice(t.mesh.positions[t.mesh.triangles[t.index][v]], subvoxel_size);
    };
    Hits hits(t);
    scan_triangle(prepare_triangle(corner(0), corner(1), corner(2)), t.target.box(), hits);
    hits.flush();
    return hits.work();
}

} // namespace

SurfaceSource::SurfaceSource(const Geometry& geometry,
                             const LatticeUnits& units,
                             std::uint64_t seed)
    : geometry_(geometry),
      subvoxel_size_(units.voxel_size * (1.0 / units.n)),
      sampler_(geometry, subvoxel_size_, seed, std::min(units.n, kMostRun)) {
    for (const Mesh& mesh : geometry.meshes) {
        const bool needed = sampler_.is_displaced(mesh) && mesh.normals.empty();
        normals_.push_back(needed ? average_normals(mesh) : std::vector<Vec3f>{});
    }
}

DisplaceTriangle SurfaceSource::displaced(std::uint32_t mesh, std::size_t triangle) const {
    const Mesh& m = geometry_.meshes[mesh];
    const std::vector<Vec3f>& normals = m.normals.empty() ? normals_[mesh] : m.normals;
    const auto [a, b, c] = m.triangles[triangle];
    return {{m.positions[a], m.positions[b], m.positions[c]},
            {normals[a], normals[b], normals[c]},
            {m.uvs[a], m.uvs[b], m.uvs[c]}};
}

std::int64_t SurfaceSource::predict_bytes(const Geometry& geometry) {
    std::int64_t bytes = SurfaceSampler::predict_bytes(geometry);
    for (const Mesh& mesh : geometry.meshes) {
        const bool moves = geometry.materials[mesh.material].height_map >= 0;
        if (moves && mesh.normals.empty()) {
            bytes += static_cast<std::int64_t>(mesh.positions.size() * sizeof(Vec3f));
        }
    }
    return bytes;
}

TriangleGatherer::TriangleGatherer(const TriangleSource& triangles,
                                   const SurfaceSource& surfaces,
                                   const LatticeUnits& units,
                                   FitMode fit)
    : triangles_(triangles), surfaces_(surfaces), units_(units), last_(fit == FitMode::Last) {}

TriangleWork TriangleGatherer::gather(std::span<const Primitive> triangles,
                                      BlockSums& block,
                                      const Progress& progress) {
    const Geometry& geometry = triangles_.geometry();
    TriangleWork work;
    std::size_t done = 0;
    for (const Primitive id : triangles) {
        if (done++ % 256 == 0) progress.check();
        const TriangleSource::Place at = triangles_.place(id & ~kTriangleBit);
        const Mesh& mesh = geometry.meshes[at.mesh];
        if (surfaces_.sampler().is_displaced(mesh)) {
            work = work + gather_displaced(at, block);
            continue;
        }
        const BlockTriangle triangle{BlockTarget(block, units_.n, mesh.material, last_),
                                     surfaces_.sampler(), units_, mesh, at.triangle};
        work = work + (surfaces_.sampler().is_constant(mesh)
                           ? gather_flat<ConstantHits>(triangle, surfaces_.subvoxel_size())
                           : gather_flat<ShadedHits>(triangle, surfaces_.subvoxel_size()));
    }
    return work;
}

TriangleWork TriangleGatherer::gather_displaced(TriangleSource::Place at, BlockSums& block) {
    const Mesh& mesh = triangles_.geometry().meshes[at.mesh];
    const SurfaceSampler& sampler = surfaces_.sampler();
    const Vec3d size = surfaces_.subvoxel_size();
    const BlockTarget target(block, units_.n, mesh.material, last_);
    const TriangleSetup setup = sampler.setup(mesh, at.triangle);
    std::int64_t hits = 0;
    const SubvoxelBox box = target.box();
    const auto emit = [&](const MicroTriangle& micro) {
        if (is_outside(micro, box)) return;
        Vec3f normal;
        std::array<float, 3> weight{};
        bool ready = false; // most micro-triangles have no hit
        scan_triangle(
            prepare_triangle(micro.p[0], micro.p[1], micro.p[2]), box,
            [&](int axis, std::int32_t i, std::int32_t j, std::int32_t k, float b0, float b1,
                float b2) {
                if (!ready) {
                    const Vec3d n = scene_normal(micro.p[0], micro.p[1], micro.p[2], size);
                    normal = to_float(n);
                    weight = hit_weights(n, units_);
                    ready = true;
                }
                ++hits;
                const Vec3f b = micro.b[0] * b0 + micro.b[1] * b1 + micro.b[2] * b2;
                const SurfaceSample s =
                    sampler.sample(setup, {axis, i, j, k, b.x, b.y, b.z}, normal);
                if (!s.covered) return;
                target.pool(target.mark(axis, i, j, k), s, weight[static_cast<std::size_t>(axis)]);
            });
    };
    displace_triangle(surfaces_.displaced(at.mesh, at.triangle), size,
                      triangles_.displacement(at.mesh), box, sampler.height_of(mesh), emit,
                      scratch_);
    return {hits, hits};
}

} // namespace heddle
