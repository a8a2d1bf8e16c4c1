#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/geometry.h>
#include <heddle/voxel/voxel_grid.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace heddle {

enum class CoverageMode : std::uint8_t {
    Columns, ///< a column counts when its centre ray meets the geometry inside the voxel
    Mask     ///< the paper's: sampled subvoxels projected along the axis   [Fabre26, 3.5]
};

enum class FitMode : std::uint8_t {
    Moments, ///< the SGGX whose second moment is the pooled one
    Last     ///< the direction of one sample, as earlier voxelizers keep
};

/// What the user asks of the voxelizer. Nothing is required.
struct VoxelizeOptions {
    Vec3d voxel_size{};           ///< scene units per axis; all 0: from `voxels`
    std::int64_t voxels = 0;      ///< along the longest axis; 0: 512
    std::optional<Bounds> bounds; ///< scene units; voxels that it touches are kept
    std::int32_t subvoxels = 8;   ///< per voxel axis: 1, 2, 4 or 8
    std::int32_t max_lobes = 3;   ///< K, 1 to 8
    CoverageMode coverage = CoverageMode::Columns;
    FitMode fit = FitMode::Moments;
    std::int32_t footprints = 0; ///< cells per axis of a voxel's face that are kept: 0, 4 or 8
    bool correlation = false;    ///< a BlockVisitor is to find what neighbouring voxels share; all
                                 ///< stays in memory
    std::int64_t samples = 0;    ///< per span, with CoverageMode::Mask; 0: two a subvoxel
    bool keep_sums = false;      ///< VoxelGridFields::masks stays in the result
    std::int64_t memory_bytes = 0; ///< peak resident size that is kept; 0: half of what is free
    std::uint64_t seed = 0;
    std::int64_t writer_bytes = 0; ///< what the caller will take to write the result, and per leaf
    std::int64_t writer_bytes_per_leaf = 0; ///< (io/vdb/predict_vdb.h says how much); in the plan
    std::string spool_dir = ".";            ///< where finished blocks go when memory is short
    std::string command;                    ///< kept in the result
};

struct VoxelizePlan;

/// Sees each finished block while its sums are at hand: how coarser levels are built in one pass.
class BlockVisitor {
public:
    virtual ~BlockVisitor() = default;

    /// Called once before the first visit().
    /// @param info       of level 0, counts unknown
    /// @param blocks     that visit() will be called for, once each, in about this order: neighbours
    ///                   follow each other (voxel/z_order.h). Block i has voxels i * kBlockVoxels and on
    /// @param spool_dir  where finished data go in a temporary file; empty: they stay in memory
    virtual void begin(const VoxelGridInfo& info,
                       std::span<const Vec3i> blocks,
                       const std::string& spool_dir) = 0;
    /// Called from several threads at once.
    /// @param rank   of the block in begin()'s list
    /// @param block  with columns and sums; may be empty
    virtual void visit(std::size_t rank, const VoxelBlock& block) = 0;

    /// One of the blocks that the planner voxelizes to see what they cost; from several threads.
    virtual void sample(const VoxelGridInfo& info, Vec3i index, const VoxelBlock& block) = 0;
    /// Adds to the plan what the visitor will hold, after the samples.
    /// @param blocks  all
    /// @param scale   how many voxels stand for one of the samples'
    virtual void plan(std::span<const Vec3i> blocks, double scale, VoxelizePlan& plan) = 0;
};

/// What the voxelizer would do, and what it would cost.
struct VoxelizePlan {
    Lattice lattice;
    VoxelGridFields fields;         ///< optional data that the result will hold
    Bounds bounds;                  ///< of what is voxelized, scene units
    Vec3i voxel_lo, voxel_hi;       ///< voxel index range [lo, hi)
    std::int32_t block_voxels = 32; ///< along a block edge
    std::int64_t blocks = 0;        ///< that a primitive's bound touches
    std::int64_t batches = 1;
    std::int64_t primitives = 0; ///< spans and triangles
    double steps = 0.0;          ///< subvoxel edges of fiber length, counted along the centrelines
    double step_length = 0.0;    ///< scene units
    double chord_error =
        0.0; ///< largest distance of a fiber from the chords it is sampled by, subvoxels
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
    double seconds =
        0.0; ///< predicted, on `thread_count()` threads of the machine that was measured
};

/// The part of plan_voxelize() that needs no look at the blocks: lattice, bounds and range of voxels.
/// @throws Error  as plan_voxelize
[[nodiscard]] VoxelizePlan plan_range(const Geometry& geometry, const VoxelizeOptions& options);

/// Plans the work: grid, blocks, batches, predicted bytes and time.
/// @throws Error  BadFile: an object without extent; InvalidArgument: voxel size not finite or <= 0,
///                more than 2^40 voxels or 2^30 along an axis; OutOfMemory: `memory_bytes` below the least; Cancelled
[[nodiscard]] VoxelizePlan plan_voxelize(const Geometry& geometry,
                                         const VoxelizeOptions& options,
                                         const Progress& progress = Progress(),
                                         BlockVisitor* visitor = nullptr);

/// Voxelizes `geometry`: same bits for any thread count, memory limit and batch size; a region
/// (`options.bounds`) gives the same voxels as the whole.      [Fabre26, 3; docs/voxelizer.md]
/// @throws Error  as plan_voxelize; Cancelled
[[nodiscard]] std::unique_ptr<VoxelSource> voxelize(const Geometry& geometry,
                                                    const VoxelizeOptions& options,
                                                    const VoxelizePlan& plan,
                                                    Progress& progress,
                                                    BlockVisitor* visitor = nullptr);

} // namespace heddle
