#pragma once

#include <heddle/voxel/voxel_level.h>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace heddle {

/// Refers to some or all blocks of another level without copying them, so that levels can be built
/// over it and the other level is kept.
class LevelSubset final : public VoxelLevel {
public:
    /// Refers to all blocks.
    /// @param whole  must outlive this
    explicit LevelSubset(const VoxelLevel& whole) : whole_(whole) {
        info_ = whole.info();
        for (std::size_t b = 0; b < whole.block_count(); ++b) blocks_.push_back(b);
    }
    /// Refers to some blocks and counts their voxels.
    /// @param whole   must outlive this
    /// @param blocks  numbers of blocks, each below whole.block_count()
    LevelSubset(const VoxelLevel& whole, std::vector<std::size_t> blocks)
        : whole_(whole), blocks_(std::move(blocks)) {
        info_ = whole.info();
        info_.voxel_count = info_.lobe_count = 0;
        VoxelBlock scratch;
        for (const std::size_t b : blocks_) {
            const VoxelBlock& block = whole.block(b, scratch);
            info_.voxel_count += static_cast<std::int64_t>(block.coverage.size());
            info_.lobe_count += static_cast<std::int64_t>(block.lobes.size());
        }
    }
    [[nodiscard]] std::size_t block_count() const override { return blocks_.size(); }
    [[nodiscard]] const VoxelBlock& block(std::size_t i, VoxelBlock& scratch) const override {
        return whole_.block(blocks_[i], scratch);
    }

private:
    const VoxelLevel& whole_;
    std::vector<std::size_t> blocks_;
};

/// Returns levels that refer to the blocks of `levels` without copying them.
/// @param levels  must outlive the result
[[nodiscard]] inline VoxelLevels share_levels(const VoxelLevels& levels) {
    VoxelLevels out;
    for (const auto& level : levels) out.push_back(std::make_unique<LevelSubset>(*level));
    return out;
}

} // namespace heddle
