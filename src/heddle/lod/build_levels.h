#pragma once

#include <heddle/base/progress.h>
#include <heddle/lod/method.h>
#include <heddle/voxel/block_visitor.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace heddle {

/// The coarsest level that may be built. Its voxels span 2^24 voxels of level 0 along each axis.
inline constexpr int kMaxLevel = 24;

/// The user's options for the levels of detail. All have defaults.
struct LodOptions {
    LodMethod method = LodMethod::Moments;
    int max_levels = kMaxLevel; ///< largest number of levels above level 0; 0: none
    int max_lobes = 0;          ///< K, 1 to 8; 0: the K of level 0
    std::uint64_t seed = 0;     ///< used by the methods `random` and `wasserstein`
};

struct BuiltBlock;
struct LevelOptions;

/// Returns the number of levels above 0 that an object has: the last has at most two voxels per
/// axis.
/// @param lo, hi  first and last voxel of level 0 per axis, inclusive
[[nodiscard]] int level_count(Vec3i lo, Vec3i hi);

/// Builds the levels of detail over blocks of level 0, in one pass over them and in any order.
///
/// Levels 1 to 5 of a block are built when the block arrives. A voxel of a level above is built
/// when its last child arrives. Sums are integers and children are merged in a fixed order, so the
/// result does not depend on threads. Voxels whose children all lie in a region are the same as
/// without the region. [docs/lod.md]
class LevelBuilder final : public BlockVisitor {
public:
    /// @param with_columns  true: the blocks will have columns and sums
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

    /// Returns the options for building the levels that accept() takes; call it after begin().
    /// Null: blocks must be visited instead, since the method is not `moments`, columns are
    /// missing, or the correlation is computed.
    [[nodiscard]] const LevelOptions* options_of_built() const;
    /// Returns how many levels of each block accept() needs, 0 to kBlockLevel; call it after
    /// begin().
    [[nodiscard]] int built_levels() const;
    /// Returns true if accept() needs BuiltBlock::top too.
    [[nodiscard]] bool wants_top() const;
    /// Takes a block whose levels are already built, instead of visit(). Called from several
    /// threads.
    /// @param rank   position of the block in begin()'s list
    /// @param block  level 0; sums are not needed
    /// @param built  its contents are moved from
    void accept(std::size_t rank, const VoxelBlock& block, BuiltBlock& built);

    /// Builds what is left of the levels. Call once, after the last visit.
    /// @param level0  the blocks that were visited
    /// @return        level 0 and the levels above it
    [[nodiscard]] VoxelLevels finish(std::unique_ptr<VoxelLevel> level0);

    /// Returns the time of all visits so far, summed over threads, in seconds.
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
