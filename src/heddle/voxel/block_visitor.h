#pragma once

#include <heddle/voxel/voxel_level.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace heddle {

/// What a planner knows of level 0 when it asks a BlockVisitor for its share.
struct LevelPlanInput {
    std::span<const Vec3i> blocks; ///< all that will be visited
    double scale = 1.0;            ///< how many voxels stand for one of the samples'
    Vec3i voxel_lo, voxel_hi;      ///< voxel index range [lo, hi)
    std::int64_t voxels = 0;       ///< of level 0, predicted
    bool correlation = false;      ///< VoxelFields::correlation
};

/// What a BlockVisitor will make and hold.
struct LevelPlan {
    std::vector<LevelSize> levels;    ///< above level 0
    std::int64_t workspace_bytes = 0; ///< what it holds while it works
    double thread_seconds = 0.0;      ///< CPU time it takes
};

/// Sees each finished block while its sums are at hand: how coarser levels are built in one pass.
class BlockVisitor {
public:
    virtual ~BlockVisitor() = default;

    /// Called once before the first visit().
    /// @param info       of level 0, counts unknown
    /// @param blocks     that visit() will be called for, once each, in about this order:
    ///                   neighbours follow each other (z_order.h). Block i has voxels i *
    ///                   kBlockVoxels and on
    /// @param spool_dir  where finished data go in a temporary file; empty: they stay in memory
    virtual void begin(const VoxelLevelInfo& info,
                       std::span<const Vec3i> blocks,
                       const std::string& spool_dir) = 0;
    /// Called from several threads at once.
    /// @param rank   of the block in begin()'s list
    /// @param block  with columns and sums; may be empty
    virtual void visit(std::size_t rank, const VoxelBlock& block) = 0;

    /// One of the blocks that the planner voxelizes to see what they cost; from several threads.
    virtual void sample(const VoxelLevelInfo& info, Vec3i index, const VoxelBlock& block) = 0;
    /// What the visitor will make and hold, after the samples.
    [[nodiscard]] virtual LevelPlan plan(const LevelPlanInput& input) = 0;
};

} // namespace heddle
