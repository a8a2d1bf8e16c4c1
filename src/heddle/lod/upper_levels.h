#pragma once

#include <heddle/lod/open_level.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace heddle {

/// One voxel of level kBlockLevel or above, until its parent is built.
struct UpperVoxel {
    /// Columns along one axis, in runs of as many words as a block has. Runs of zeros are left out,
    /// so memory grows with the silhouette and not with the size of the voxel.
    static constexpr std::size_t kRunWords = std::size_t{1} << (2 * kBlockLevel);
    using Run = std::unique_ptr<std::array<std::uint64_t, kRunWords>>;
    using Runs = std::vector<std::pair<std::uint64_t, Run>>; ///< ascending position in Z-order

    OpenVoxel voxel;
    std::vector<DirectionSums> lobes;
    std::vector<MapSums> maps;
    std::array<Runs, 3> columns;
};

/// Builds the levels above kBlockLevel. A voxel is built when its last child arrives, by the thread
/// that delivers the child; then its children are freed. If blocks arrive in Z-order, only about
/// two voxels per level are unfinished at any time.
class UpperLevels {
public:
    /// Called with each finished voxel, from several threads.
    /// @param number  number of the voxel in its level, below count(level)
    using Store = std::function<void(int level, std::size_t number, VoxelBlock&)>;

    /// @param blocks  indices of the blocks in Z-order (voxel/z_order.h)
    /// @param top     last level to build; nothing is built unless it is above kBlockLevel
    UpperLevels(std::span<const Vec3i> blocks, int top, const LevelOptions& options, Store store);

    /// Takes a block's voxel of level kBlockLevel; null if the block is empty.
    void take(std::size_t rank, std::unique_ptr<UpperVoxel> voxel);
    /// Returns the number of voxels of a level that may exist.
    [[nodiscard]] std::size_t count(int level) const;
    /// These return the indices of those voxels, and their columns if options.fields.correlation.
    [[nodiscard]] std::vector<Vec3i> index_of(int level) const;
    [[nodiscard]] std::vector<std::array<UpperVoxel::Runs, 3>> take_columns(int level);

private:
    struct Node {
        Vec3i index;
        std::uint32_t parent = 0; ///< its number in the next level
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

/// Returns the one voxel of a block's level kBlockLevel; null if there is none.
[[nodiscard]] std::unique_ptr<UpperVoxel> take_upper(const OpenLevel& level);

} // namespace heddle
