#pragma once

#include <heddle/voxel/leaf_voxels.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace heddle {

/// A level's leaves in Z-order, so that all voxels below a coarser voxel are consecutive. A
/// LeafTable would need a lookup for each leaf.
class VoxelIndex {
public:
    /// @param source  must outlive this
    explicit VoxelIndex(const VoxelLevel& source);

    [[nodiscard]] const VoxelLevel& source() const { return source_; }

    /// Calls visit(BlockVoxel) for all voxels of the source inside a voxel that is `levels` levels
    /// above it, in a fixed order. Thread-safe.
    /// @param levels  0: the voxel itself
    /// @param index   index of the coarser voxel
    template <typename Visit>
    void for_each_below(int levels, Vec3i index, const Visit& visit) const {
        VoxelBlock scratch;
        const int up = levels > 3 ? levels - 3 : 0;    // levels above that of a leaf's size
        const int below = levels < 3 ? 3 - levels : 0; // levels below it
        const Vec3i cell{index.x >> below, index.y >> below, index.z >> below};
        const VoxelBlock* block = nullptr;
        for (std::size_t i = first_in({cell.x << up, cell.y << up, cell.z << up});
             i < leaves_.size() && is_in(leaves_[i].cell, cell, up); ++i) {
            if (block == nullptr || leaves_[i].block != leaves_[i - 1].block) {
                block = &source_.block(leaves_[i].block, scratch);
            }
            for_each_voxel(*block, block->leaves[leaves_[i].leaf], [&](const BlockVoxel& v) {
                if (is_in(v.at, index, levels)) visit(v);
            });
        }
    }

private:
    struct LeafEntry {
        Vec3i cell; ///< its origin / 8
        std::uint32_t block = 0;
        std::uint32_t leaf = 0;
    };
    /// Returns the first leaf that is not before `cell` in Z-order.
    [[nodiscard]] std::size_t first_in(Vec3i cell) const;
    [[nodiscard]] static bool is_in(Vec3i leaf, Vec3i cell, int up) {
        return Vec3i{leaf.x >> up, leaf.y >> up, leaf.z >> up} == cell;
    }
    const VoxelLevel& source_;
    std::vector<LeafEntry> leaves_;
};

} // namespace heddle
