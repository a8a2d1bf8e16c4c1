#pragma once

#include <heddle/base/progress.h>
#include <heddle/surface/surface_source.h>
#include <heddle/voxelize/bin.h>
#include <heddle/voxelize/plan.h>
#include <heddle/yarn/fiber_source.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace heddle {

/// The data that are computed from a geometry before its blocks are voxelized: arc lengths and
/// frames of yarns, averaged textures and the primitives of each block. They depend on the lattice,
/// the range of voxels and the seed, but on no other option.
class PreparedGeometry {
public:
    /// @param geometry  must outlive this, unchanged
    PreparedGeometry(const Geometry& geometry,
                     const Lattice& lattice,
                     Vec3i voxel_lo,
                     Vec3i voxel_hi,
                     std::uint64_t seed);

    const Geometry& geometry;
    const Lattice lattice;
    const LatticeUnits units;
    const FiberSource fibers;
    const TriangleSource triangles;
    const SurfaceSource surfaces;
    const BlockRange range;

    /// Returns the blocks' primitives, counted at the first call. @throws Error  Cancelled
    const Bins& bins(const Progress& progress);
    /// Frees the memory of bins().
    void drop_bins() { bins_.reset(); }

    /// Returns true if it was made for the same geometry, plan and seed. It does not notice that a
    /// geometry was modified in place.
    [[nodiscard]] bool
    is_of(const Geometry& other, const VoxelizePlan& plan, std::uint64_t seed) const;

private:
    std::optional<Bins> bins_;
};

/// Holds what plan_voxelize() has prepared until the first run with the plan takes it, so that it
/// is freed before the result is written. Thread-safe.
class PreparedSlot {
public:
    explicit PreparedSlot(std::unique_ptr<PreparedGeometry> prepared)
        : prepared_(std::move(prepared)) {}

    /// Returns the prepared geometry; null if it was taken before.
    [[nodiscard]] std::unique_ptr<PreparedGeometry> take() {
        const std::scoped_lock lock(mutex_);
        return std::move(prepared_);
    }

private:
    std::mutex mutex_;
    std::unique_ptr<PreparedGeometry> prepared_;
};

/// Returns the prepared geometry for a run with `plan`: the planner's, or a new one if the
/// planner's was taken before or was made for another geometry, lattice, range or seed.
[[nodiscard]] std::unique_ptr<PreparedGeometry>
take_prepared(const VoxelizePlan& plan, const Geometry& geometry, std::uint64_t seed);

} // namespace heddle
