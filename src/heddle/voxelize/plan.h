#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/geometry.h>
#include <heddle/voxel/block_visitor.h>
#include <heddle/voxelize/voxelize_options.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace heddle {

class PreparedSlot;

/// What the voxelizer would do, and what it would cost.
struct VoxelizePlan {
    Lattice lattice;
    VoxelFields fields;             ///< optional data that the result will hold
    Bounds bounds;                  ///< of what is voxelized, scene units
    Vec3i voxel_lo, voxel_hi;       ///< voxel index range [lo, hi)
    std::int32_t block_voxels = 32; ///< along a block edge
    std::int64_t blocks = 0;        ///< that a primitive's bound touches
    std::int64_t batches = 1;
    std::int64_t primitives = 0; ///< spans and triangles
    double steps = 0.0;          ///< subvoxel edges of fiber length, counted along the centrelines
    double step_length = 0.0;    ///< scene units
    /// largest distance of a fiber from the chords it is sampled by, subvoxels
    double chord_error = 0.0;
    // measured on a sample of the blocks:
    std::int64_t voxels = 0;
    std::int64_t lobes = 0;
    std::int64_t leaves = 0;
    std::int64_t touched_subvoxels = 0;
    std::int64_t peak_bytes = 0;    ///< predicted peak resident size, the caller's share included
    std::vector<LevelSize> levels;  ///< above level 0, as a BlockVisitor plans them
    std::int64_t visitor_bytes = 0; ///< what it holds while it works, of the peak
    double visitor_seconds = 0.0;   ///< CPU time it takes, of `seconds`
    bool spool = false;             ///< finished blocks wait in a temporary file
    /// predicted, on `thread_count()` threads of the machine that was measured
    double seconds = 0.0;
    /// what the first run by this plan, or by a copy of it, need not make again (prepare.h)
    std::shared_ptr<PreparedSlot> prepared;
};

/// The part of plan_voxelize() that needs no look at the blocks: lattice, bounds and range of
/// voxels.
/// @throws Error  as plan_voxelize
[[nodiscard]] VoxelizePlan plan_range(const Geometry& geometry, const VoxelizeOptions& options);

/// Plans the work: grid, blocks, batches, predicted bytes and time.
/// @throws Error  BadFile: an object without extent; InvalidArgument: voxel size not finite or <=
///                0, more than 2^40 voxels or 2^30 along an axis, curves of a surface's material;
///                OutOfMemory: `memory_bytes` below the least; Cancelled
[[nodiscard]] VoxelizePlan plan_voxelize(const Geometry& geometry,
                                         const VoxelizeOptions& options,
                                         const Progress& progress = Progress(),
                                         BlockVisitor* visitor = nullptr);

} // namespace heddle
