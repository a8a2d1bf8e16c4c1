#pragma once

#include <heddle/voxel/spool.h>
#include <heddle/voxel/voxel_level.h>

#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace heddle {

/// Stores finished blocks from several threads, in memory or in a temporary file.
class BlockStore {
public:
    /// @param blocks  number of blocks
    /// @param spool   true: a temporary file
    /// @param folder  folder of that file
    BlockStore(VoxelLevelInfo info, std::size_t blocks, bool spool, const std::string& folder) {
        if (spool) {
            spooled_ = std::make_unique<SpooledLevel>(folder);
            spooled_->set_info(std::move(info));
            spooled_->resize(blocks);
        } else {
            grid_ = std::make_unique<MemoryLevel>();
            grid_->set_info(std::move(info));
            grid_->blocks.resize(blocks);
        }
    }

    /// Stores block i. The contents of `block` are unspecified afterwards.
    void keep(std::size_t i, VoxelBlock& block) {
        block.shrink_to_fit();
        const std::scoped_lock lock(mutex_);
        voxels_ += static_cast<std::int64_t>(block.coverage.size());
        lobes_ += static_cast<std::int64_t>(block.lobes.size());
        if (spooled_) {
            spooled_->store(i, block);
        } else {
            grid_->blocks[i] = std::move(block);
        }
    }

    /// Returns the level of all stored blocks, with its counts. Call once, after the last block.
    [[nodiscard]] std::unique_ptr<VoxelLevel> finish() {
        std::unique_ptr<VoxelLevel> kept = std::move(grid_);
        if (spooled_) kept = std::move(spooled_);
        VoxelLevelInfo info = kept->info();
        info.voxel_count = voxels_;
        info.lobe_count = lobes_;
        kept->set_info(std::move(info));
        return kept;
    }

private:
    std::mutex mutex_;
    std::unique_ptr<MemoryLevel> grid_;
    std::unique_ptr<SpooledLevel> spooled_;
    std::int64_t voxels_ = 0;
    std::int64_t lobes_ = 0;
};

} // namespace heddle
