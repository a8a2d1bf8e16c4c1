#include <heddle/voxelize/prepare.h>

#include <heddle/voxelize/chord/yarn_frame.h>

#include <algorithm>

namespace heddle {
namespace {

/// Returns true if the views point into the geometry's arrays.
bool points_into(const FiberView& fibers, const SurfaceView& surfaces, const Geometry& geometry) {
    if (fibers.set_count != geometry.curves.size()) return false;
    if (surfaces.mesh_count != geometry.meshes.size()) return false;
    for (std::size_t s = 0; s < fibers.set_count; ++s) {
        if (fibers.sets[s].points != geometry.curves[s].points.data()) return false;
    }
    for (std::size_t m = 0; m < surfaces.mesh_count; ++m) {
        if (surfaces.meshes[m].positions != geometry.meshes[m].positions.data()) return false;
    }
    return true;
}

} // namespace

PreparedGeometry::PreparedGeometry(const Geometry& geometry_in,
                                   const Lattice& lattice_in,
                                   Vec3i voxel_lo,
                                   Vec3i voxel_hi,
                                   std::uint64_t seed)
    : geometry(geometry_in),
      lattice(lattice_in),
      units(lattice_in),
      fibers(geometry_in, piece_length_of(units), seed),
      triangles(geometry_in),
      surfaces(geometry_in, units, seed),
      range(voxel_lo, voxel_hi) {}

const Bins& PreparedGeometry::bins(const Progress& progress) {
    if (!bins_) bins_.emplace(fibers, triangles, units, range, progress);
    return *bins_;
}

bool PreparedGeometry::is_of(const Geometry& other,
                             const VoxelizePlan& plan,
                             std::uint64_t seed) const {
    return &other == &geometry && plan.lattice.voxel_size == lattice.voxel_size &&
           plan.lattice.subvoxels == lattice.subvoxels && plan.voxel_lo == range.voxel_lo &&
           plan.voxel_hi == range.voxel_hi && seed == fibers.seed() &&
           points_into(fibers.view(), surfaces.view(), other);
}

std::unique_ptr<PreparedGeometry>
take_prepared(const VoxelizePlan& plan, const Geometry& geometry, std::uint64_t seed) {
    std::unique_ptr<PreparedGeometry> prepared;
    if (plan.prepared) prepared = plan.prepared->take();
    if (prepared && prepared->is_of(geometry, plan, seed)) return prepared;
    prepared.reset(); // free it before the new one is made
    return std::make_unique<PreparedGeometry>(geometry, plan.lattice, plan.voxel_lo, plan.voxel_hi,
                                              seed);
}

} // namespace heddle
