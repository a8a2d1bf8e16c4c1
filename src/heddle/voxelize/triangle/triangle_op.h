#pragma once

#include <heddle/base/platform.h>
#include <heddle/voxelize/triangle/displace.h>
#include <heddle/voxelize/triangle/surface_hits.h>
#include <heddle/voxelize/triangle/triangle_scan.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace heddle {

namespace triangle_detail {

/// Returns true only if the triangle has no hit in the box, as about half of those near a block.
[[nodiscard]] HEDDLE_HD inline bool is_outside(const MicroTriangle& t, const SubvoxelBox& box) {
    bool outside = false;
    for (int a = 0; a < 3; ++a) { // one subvoxel, more than snapping can move a vertex
        const double lo = box.lo[a] - 1.0;
        const double hi = box.hi[a] + 1.0;
        const double x = t.p[0][a];
        const double y = t.p[1][a];
        const double z = t.p[2][a];
        outside |= (x < lo && y < lo && z < lo) || (x > hi && y > hi && z > hi);
    }
    return outside;
}

/// The hits of a displaced triangle's micro-triangles, each sampled with the normal of its own.
template <typename Sums>
class DisplacedHits {
public:
    HEDDLE_HD explicit DisplacedHits(const BlockTriangle<Sums>& triangle)
        : t_(triangle), setup_(triangle.set_up()), box_(triangle.target.box()) {}

    HEDDLE_HD void operator()(const MicroTriangle& micro) {
        if (is_outside(micro, box_)) return;
        Vec3f normal;
        std::array<float, 3> weight{};
        bool ready = false; // most micro-triangles have no hit
        scan_triangle(prepare_triangle(micro.p[0], micro.p[1], micro.p[2]), box_,
                      [&](int axis, std::int32_t i, std::int32_t j, std::int32_t k, float b0,
                          float b1, float b2) {
                          if (!ready) {
                              const Vec3d n = scene_normal(micro.p[0], micro.p[1], micro.p[2],
                                                           t_.surfaces.subvoxel_size);
                              normal = to_float(n);
                              weight = hit_weights(n, t_.units);
                              ready = true;
                          }
                          ++hits_;
                          const Vec3f b = micro.b[0] * b0 + micro.b[1] * b1 + micro.b[2] * b2;
                          const SurfaceSample s = sample_at(t_.surfaces.seed, setup_,
                                                            {axis, i, j, k, b.x, b.y, b.z}, normal);
                          if (!s.covered) return;
                          const int cell = t_.target.cell_of(i, j, k);
                          t_.target.mark(cell, axis, i, j, k);
                          t_.target.pool(cell, s, weight[static_cast<std::size_t>(axis)]);
                      });
    }
    [[nodiscard]] HEDDLE_HD TriangleWork work() const { return {hits_, hits_}; }

private:
    const BlockTriangle<Sums>& t_;
    TriangleSetup setup_;
    SubvoxelBox box_;
    std::int64_t hits_ = 0;
};

/// Returns the corners, normals and uv of a triangle to be displaced.
[[nodiscard]] HEDDLE_HD inline DisplaceTriangle displaced(const MeshView& m,
                                                          std::uint64_t triangle) {
    const std::array<std::uint32_t, 3> corner = m.triangles[triangle];
    const std::uint32_t a = corner[0], b = corner[1], c = corner[2];
    return {{m.positions[a], m.positions[b], m.positions[c]},
            {m.move_normals[a], m.move_normals[b], m.move_normals[c]},
            {m.uvs[a], m.uvs[b], m.uvs[c]}};
}

/// Adds a triangle that is not displaced.
template <typename Hits, typename Sums>
HEDDLE_HD inline TriangleWork add_flat(const BlockTriangle<Sums>& t) {
    const MeshView& mesh = t.mesh();
    const std::array<std::uint32_t, 3> corner = mesh.triangles[t.place.triangle];
    Vec3d p[3];
    for (std::size_t v = 0; v < 3; ++v)
        p[v] = to_lattice(mesh.positions[corner[v]], t.surfaces.subvoxel_size);
    Hits hits(t);
    scan_triangle(prepare_triangle(p[0], p[1], p[2]), t.target.box(), hits);
    hits.flush();
    return hits.work();
}

/// Adds a displaced triangle.
template <typename Sums, typename Scratch>
HEDDLE_HD inline TriangleWork add_displaced(const BlockTriangle<Sums>& t, Scratch&& scratch) {
    const MeshView& mesh = t.mesh();
    DisplacedHits<Sums> hits(t);
    displace_triangle(displaced(mesh, t.place.triangle), t.surfaces.subvoxel_size,
                      mesh.displacement, t.target.box(), t.surfaces.height_of(mesh), hits, scratch);
    return hits.work();
}

} // namespace triangle_detail

/// Adds the part of one triangle inside a block to the block's sums, on host and device.
///
/// If the triangle hits the centre line of a column in a subvoxel of the block, the bits of the
/// column and the subvoxel are set, and the normal is pooled, weighted by the area per hit
/// (hit_weight()). Values of maps and anisotropic tangents are added to the map sums if there are
/// any. A hit that alpha cuts away is ignored.
///
/// @tparam Kind    kind of the mesh; code for the other kinds would need registers of the device
/// @param lo,hi    voxel range of the block, [lo, hi), at most kBlockVoxels per axis
/// @param sums     sums of the block for the material of the triangle's mesh (surface_hits.h)
/// @param scratch  DisplaceScratch or NoScratch
template <SurfaceKind Kind, typename Sums, typename Scratch>
HEDDLE_HD inline TriangleWork add_triangle(const SurfaceView& surfaces,
                                           TriangleId place,
                                           const LatticeUnits& units,
                                           Vec3i lo,
                                           Vec3i hi,
                                           Sums& sums,
                                           Scratch&& scratch) {
    using namespace triangle_detail;
    const BlockTriangle<Sums> t{BlockTarget<Sums>(sums, lo, hi, units.n), surfaces, units, place};
    if constexpr (Kind == SurfaceKind::Constant) return add_flat<ConstantHits<Sums>>(t);
    if constexpr (Kind == SurfaceKind::Shaded) return add_flat<ShadedHits<Sums>>(t);
    if constexpr (Kind == SurfaceKind::Displaced) return add_displaced(t, scratch);
}

/// Adds a triangle of any kind.
template <typename Sums, typename Scratch>
HEDDLE_HD inline TriangleWork add_triangle(const SurfaceView& surfaces,
                                           TriangleId place,
                                           const LatticeUnits& units,
                                           Vec3i lo,
                                           Vec3i hi,
                                           Sums& sums,
                                           Scratch&& scratch) {
    switch (surfaces.meshes[place.mesh].kind) {
    case SurfaceKind::Constant:
        return add_triangle<SurfaceKind::Constant>(surfaces, place, units, lo, hi, sums, scratch);
    case SurfaceKind::Shaded:
        return add_triangle<SurfaceKind::Shaded>(surfaces, place, units, lo, hi, sums, scratch);
    case SurfaceKind::Displaced: break;
    }
    return add_triangle<SurfaceKind::Displaced>(surfaces, place, units, lo, hi, sums, scratch);
}

} // namespace heddle
