#pragma once

#include <heddle/lod/upper_levels.h>
#include <heddle/voxel/voxel_level.h>

#include <array>
#include <memory>

namespace heddle {

/// The levels above 0 of one block, built by a device instead of LevelBuilder::visit().
struct BuiltBlock {
    std::array<VoxelBlock, kBlockLevel> level; ///< levels 1 to kBlockLevel, as from store_level()
    std::unique_ptr<UpperVoxel> top; ///< the voxel of kBlockLevel; null if the block is empty
};

} // namespace heddle
