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

/// What the voxelizer will do, and what it will cost.
struct VoxelizePlan {
    Lattice lattice;
    VoxelFields fields;             ///< optional fields that the result will have
    Bounds bounds;                  ///< bounds of what is voxelized, scene units
    Vec3i voxel_lo, voxel_hi;       ///< voxel index range [lo, hi)
    std::int32_t block_voxels = 32; ///< along a block edge
    std::int64_t blocks = 0;        ///< blocks that a primitive's bounds touch
    std::int64_t batches = 1;
    std::int64_t primitives = 0; ///< spans and triangles
    double steps = 0.0;          ///< length of all fibers along the centrelines, in subvoxel edges
    double step_length = 0.0;    ///< scene units
    /// largest distance of a fiber from the chords that approximate it, subvoxels
    double chord_error = 0.0;
    // measured on a sample of the blocks:
    std::int64_t voxels = 0;
    std::int64_t lobes = 0;
    std::int64_t leaves = 0;
    std::int64_t touched_subvoxels = 0;
    std::int64_t peak_bytes = 0;    ///< predicted peak resident size, including the caller's part
    std::vector<LevelSize> levels;  ///< levels above 0, as a BlockVisitor plans them
    std::int64_t visitor_bytes = 0; ///< memory of the visitor, a part of the peak
    double visitor_seconds = 0.0;   ///< CPU time of the visitor, a part of `seconds`
    bool spool = false;             ///< finished blocks are stored in a temporary file
    /// predicted time on `thread_count()` threads of the machine that was measured
    double seconds = 0.0;
    /// data that the first run with this plan or a copy of it reuses (prepare.h)
    std::shared_ptr<PreparedSlot> prepared;
};

/// Returns the part of plan_voxelize() that does not depend on the blocks: lattice, bounds and
/// range of voxels.
/// @throws Error  as plan_voxelize()
[[nodiscard]] VoxelizePlan plan_range(const Geometry& geometry, const VoxelizeOptions& options);

/// Plans the work: lattice, blocks, batches, predicted bytes and time.
/// @param visitor  visitor of the run that is planned; may be null
/// @throws Error   BadFile: an object without extent; InvalidArgument: a voxel size that is not
///                 finite or <= 0, more than 2^40 voxels or 2^30 along an axis, curves with the
///                 material of a surface; OutOfMemory: `memory_bytes` is too small; Cancelled
[[nodiscard]] VoxelizePlan plan_voxelize(const Geometry& geometry,
                                         const VoxelizeOptions& options,
                                         const Progress& progress = Progress(),
                                         BlockVisitor* visitor = nullptr);

} // namespace heddle
