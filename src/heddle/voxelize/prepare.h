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

/// What is made of a geometry before its blocks are voxelized, for one lattice, range of voxels and
/// seed, whatever the other options are: arc lengths and frames of yarns, averaged textures, and
/// which blocks hold what.
class PreparedGeometry {
public:
    /// @param geometry  must outlive it, unchanged
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

    /// The blocks' primitives, counted at the first call. @throws Error  Cancelled
    const Bins& bins(const Progress& progress);
    /// Gives the counts' memory back.
    void drop_bins() { bins_.reset(); }

    /// True if it was made for the same; of a geometry that was changed in place this does not
    /// tell.
    [[nodiscard]] bool
    is_of(const Geometry& other, const VoxelizePlan& plan, std::uint64_t seed) const;

private:
    std::optional<Bins> bins_;
};

/// Where plan_voxelize() leaves what it has prepared, until the first run by the plan takes it: it
/// is not in memory any more while the result is written. Safe from several threads.
class PreparedSlot {
public:
    explicit PreparedSlot(std::unique_ptr<PreparedGeometry> prepared)
        : prepared_(std::move(prepared)) {}

    /// Null once it is taken.
    [[nodiscard]] std::unique_ptr<PreparedGeometry> take() {
        const std::scoped_lock lock(mutex_);
        return std::move(prepared_);
    }

private:
    std::mutex mutex_;
    std::unique_ptr<PreparedGeometry> prepared_;
};

/// What a run by `plan` needs: what the planner has prepared, or the same made anew where that is
/// taken or was made for another geometry, lattice, range or seed.
[[nodiscard]] std::unique_ptr<PreparedGeometry>
take_prepared(const VoxelizePlan& plan, const Geometry& geometry, std::uint64_t seed);

} // namespace heddle
