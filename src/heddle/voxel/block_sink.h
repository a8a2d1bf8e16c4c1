#pragma once

#include <heddle/voxel/block_store.h>
#include <heddle/voxel/block_visitor.h>
#include <heddle/voxel/voxel_level.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace heddle {

/// Receives a voxelizer's finished blocks from several threads. Each is passed to a visitor while
/// its sums are available, and then stored, without the sums unless the result holds them.
class BlockSink {
public:
    /// @param info     info of the result, without counts; sums are dropped unless fields.masks
    /// @param blocks   the index of every block, by rank
    /// @param spool    true: blocks are stored in a temporary file
    /// @param folder   folder of that file
    /// @param visitor  may be null
    BlockSink(const VoxelLevelInfo& info,
              std::span<const Vec3i> blocks,
              bool spool,
              const std::string& folder,
              BlockVisitor* visitor)
        : store_(info, blocks.size(), spool, folder),
          visitor_(visitor),
          keep_sums_(info.fields.masks) {
        if (visitor_ != nullptr) visitor_->begin(info, blocks, spool ? folder : "");
    }

    /// Visits and stores a block, whose contents are unspecified afterwards.
    void take(std::size_t rank, VoxelBlock& block) {
        if (visitor_ != nullptr) visitor_->visit(rank, block);
        keep(rank, block);
    }
    /// Stores a block that the visitor has received in another way.
    void keep(std::size_t rank, VoxelBlock& block) {
        if (!keep_sums_) drop_sums(block);
        store_.keep(rank, block);
    }

    /// Returns the level of all stored blocks. Call once, after the last block.
    [[nodiscard]] std::unique_ptr<VoxelLevel> finish() { return store_.finish(); }

private:
    BlockStore store_;
    BlockVisitor* visitor_;
    bool keep_sums_;
};

} // namespace heddle
