#pragma once

#include <heddle/voxel/voxel_level.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace heddle {

/// What a planner knows about level 0 when it asks a BlockVisitor for its cost.
struct LevelPlanInput {
    std::span<const Vec3i> blocks; ///< indices of all blocks that will be visited
    double scale = 1.0;            ///< voxels of level 0 per voxel of the sampled blocks
    Vec3i voxel_lo, voxel_hi;      ///< voxel index range [lo, hi)
    std::int64_t voxels = 0;       ///< predicted number of voxels of level 0
    bool correlation = false;      ///< VoxelFields::correlation
};

/// What a BlockVisitor will build, and what it costs.
struct LevelPlan {
    std::vector<LevelSize> levels;    ///< above level 0
    std::int64_t workspace_bytes = 0; ///< memory that it occupies while it works
    double thread_seconds = 0.0;      ///< CPU time it takes
};

/// Receives each finished block while its sums are available, so that coarser levels are built in
/// the same pass.
class BlockVisitor {
public:
    virtual ~BlockVisitor() = default;

    /// Called once before the first visit().
    /// @param info       info of level 0, without counts
    /// @param blocks     indices of the blocks that visit() will be called for, once each, in about
    ///                   this order (z_order.h). The first voxel of block i is i * kBlockVoxels
    /// @param spool_dir  folder of a temporary file for finished data; empty: they stay in memory
    virtual void begin(const VoxelLevelInfo& info,
                       std::span<const Vec3i> blocks,
                       const std::string& spool_dir) = 0;
    /// Receives one finished block. Called from several threads at once.
    /// @param rank   position of the block in begin()'s list
    /// @param block  with columns and sums; may be empty
    virtual void visit(std::size_t rank, const VoxelBlock& block) = 0;

    /// Receives a block that the planner voxelizes to measure its cost. Called from several
    /// threads.
    virtual void sample(const VoxelLevelInfo& info, Vec3i index, const VoxelBlock& block) = 0;
    /// Returns what the visitor will build and what it costs. Called after the last sample().
    [[nodiscard]] virtual LevelPlan plan(const LevelPlanInput& input) = 0;
};

} // namespace heddle
