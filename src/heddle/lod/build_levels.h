#pragma once

#include <heddle/base/progress.h>
#include <heddle/lod/method.h>
#include <heddle/voxel/block_visitor.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace heddle {

/// Coarsest level that is ever built: 2^24 voxels of level 0 along each axis.
inline constexpr int kMaxLevel = 24;

/// What the user asks of the levels of detail. Nothing is required.
struct LodOptions {
    LodMethod method = LodMethod::Moments;
    int max_levels = kMaxLevel; ///< above level 0, at most; 0: none
    int max_lobes = 0;          ///< K, 1 to 8; 0: as level 0 has
    std::uint64_t seed = 0;     ///< of the methods `random` and `wasserstein`
};

struct BuiltBlock;
struct LevelOptions;

/// Levels above 0 that an object has: until at most two voxels per axis are left.
/// @param lo, hi  its first and last voxel of level 0, inclusive
[[nodiscard]] int level_count(Vec3i lo, Vec3i hi);

/// Builds the levels of detail over blocks of level 0, in one pass over them and in any order.
///
/// A block's levels 1 to 5 are built at once when the block is there, the levels above when the
/// last child of a voxel is. Sums are integers and children are taken in a fixed order: threads do
/// not show, nor does a region in the voxels whose children it holds.              [docs/lod.md]
class LevelBuilder final : public BlockVisitor {
public:
    /// @param with_columns  blocks will come with columns and sums
    explicit LevelBuilder(const LodOptions& options, bool with_columns = true);
    ~LevelBuilder() override;
    LevelBuilder(const LevelBuilder&) = delete;
    LevelBuilder& operator=(const LevelBuilder&) = delete;

    void begin(const VoxelLevelInfo& info,
               std::span<const Vec3i> blocks,
               const std::string& spool_dir) override;
    void visit(std::size_t rank, const VoxelBlock& block) override;
    void sample(const VoxelLevelInfo& info, Vec3i index, const VoxelBlock& block) override;
    [[nodiscard]] LevelPlan plan(const LevelPlanInput& input) override;

    /// What levels that come by accept() are built with, after begin(). Null: blocks have to be
    /// visited, since the method is not `moments`, columns are missing, or neighbours share
    /// something.
    [[nodiscard]] const LevelOptions* options_of_built() const;
    /// Levels that accept() wants of each block, after begin(): 0 to kBlockLevel.
    [[nodiscard]] int built_levels() const;
    /// True if it wants BuiltBlock::top too.
    [[nodiscard]] bool wants_top() const;
    /// Takes a block whose levels are built, in place of visit(); from several threads.
    /// @param rank   as visit()
    /// @param block  level 0; sums are not needed
    /// @param built  taken apart
    void accept(std::size_t rank, const VoxelBlock& block, BuiltBlock& built);

    /// The levels above 0, after the last visit.
    /// @param level0  the blocks that were visited
    /// @return        level 0 and those above it
    [[nodiscard]] VoxelLevels finish(std::unique_ptr<VoxelLevel> level0);

    /// Time that visits have taken so far, summed over threads, seconds.
    [[nodiscard]] double visit_seconds() const;

private:
    void fill_shared(int level, std::span<VoxelBlock> blocks);

    struct Impl;
    struct Sample;
    LodOptions options_;
    bool with_columns_;
    std::unique_ptr<Impl> impl_;
    std::unique_ptr<Sample> sample_;
};

} // namespace heddle
