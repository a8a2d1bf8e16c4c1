#pragma once

#include <heddle/lod/open_level.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace heddle {

/// One voxel of a level above the blocks' own, or of theirs, while its parent waits for it.
struct UpperVoxel {
    /// Columns along one axis: those words that are not all zero, in runs of as many as a block
    /// has.
    /// Memory is the silhouette's, however large the voxel.
    static constexpr std::size_t kRunWords = std::size_t{1} << (2 * kBlockLevel);
    using Run = std::unique_ptr<std::array<std::uint64_t, kRunWords>>;
    using Runs = std::vector<std::pair<std::uint64_t, Run>>; ///< by place in Z-order, ascending

    OpenVoxel voxel;
    std::vector<DirectionSums> lobes;
    std::vector<MapSums> maps;
    std::array<Runs, 3> columns;
};

/// The levels above the blocks' own: each voxel is built when the last of its children arrives, by
/// the thread that brings it, and then its children are dropped. Blocks that come in Z-order leave
/// few voxels open: about 2 a level.
class UpperLevels {
public:
    /// Called with each finished voxel, from several threads.
    /// @param number  of the voxel in its level, below count(level)
    using Store = std::function<void(int level, std::size_t number, VoxelBlock&)>;

    /// @param blocks  in Z-order (voxel/z_order.h)
    /// @param top     last level to build, above kBlockLevel; else nothing is done
    UpperLevels(std::span<const Vec3i> blocks, int top, const LevelOptions& options, Store store);

    /// Takes a block's voxel of level kBlockLevel; null where the block is empty.
    void take(std::size_t rank, std::unique_ptr<UpperVoxel> voxel);
    /// Voxels of a level that may be there.
    [[nodiscard]] std::size_t count(int level) const;
    /// Indices of those, and their columns where options.fields.correlation keeps them.
    [[nodiscard]] std::vector<Vec3i> index_of(int level) const;
    [[nodiscard]] std::vector<std::array<UpperVoxel::Runs, 3>> take_columns(int level);

private:
    struct Node {
        Vec3i index;
        std::uint32_t parent = 0; ///< number in the next level
        std::atomic<int> waits{0};
        std::array<std::unique_ptr<UpperVoxel>, 8> child;
        std::array<UpperVoxel::Runs, 3> kept;
    };
    struct NodeLevel {
        std::vector<Node> nodes;
    };
    [[nodiscard]] std::unique_ptr<UpperVoxel> close(Node& node, int level, std::size_t number);

    const LevelOptions& options_;
    Store store_;
    std::vector<Vec3i> blocks_;
    std::vector<std::uint32_t> parent_of_block_;
    std::vector<NodeLevel> levels_; ///< from kBlockLevel + 1 on
};

/// Takes the one voxel of a block's level kBlockLevel out of it; null where there is none.
[[nodiscard]] std::unique_ptr<UpperVoxel> take_upper(const OpenLevel& level);

} // namespace heddle
