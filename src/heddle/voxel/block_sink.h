#pragma once

#include <heddle/voxel/block_store.h>
#include <heddle/voxel/block_visitor.h>
#include <heddle/voxel/voxel_level.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace heddle {

/// Where a voxelizer's finished blocks go, from several threads: each is shown to a visitor while
/// its sums are at hand, and kept without the sums that the result does not hold.
class BlockSink {
public:
    /// @param info     of the result, counts unknown; without fields.masks, sums are dropped
    /// @param blocks   the index of every block, by rank
    /// @param spool    blocks wait in a temporary file
    /// @param folder   of the file
    /// @param visitor  may be null
    BlockSink(const VoxelLevelInfo& info,
              std::span<const Vec3i> blocks,
              bool spool,
              const std::string& folder,
              BlockVisitor* visitor)
        : keeper_(info, blocks.size(), spool, folder),
          visitor_(visitor),
          keep_sums_(info.fields.masks) {
        if (visitor_ != nullptr) visitor_->begin(info, blocks, spool ? folder : "");
    }

    /// Takes a block; what is left in it has no meaning.
    void take(std::size_t rank, VoxelBlock& block) {
        if (visitor_ != nullptr) visitor_->visit(rank, block);
        keep(rank, block);
    }
    /// The same of a block that the visitor has by another way.
    void keep(std::size_t rank, VoxelBlock& block) {
        if (!keep_sums_) drop_sums(block);
        keeper_.keep(rank, block);
    }

    [[nodiscard]] std::unique_ptr<VoxelLevel> finish() { return keeper_.finish(); }

private:
    BlockStore keeper_;
    BlockVisitor* visitor_;
    bool keep_sums_;
};

} // namespace heddle
