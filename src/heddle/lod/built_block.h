#pragma once

#include <heddle/lod/upper_levels.h>
#include <heddle/voxel/voxel_level.h>

#include <array>
#include <memory>

namespace heddle {

/// The levels of one block above 0, built elsewhere than in LevelBuilder::visit(): by a device.
struct BuiltBlock {
    std::array<VoxelBlock, kBlockLevel> level; ///< 1 to kBlockLevel, as store_level() gives them
    std::unique_ptr<UpperVoxel> top;           ///< of kBlockLevel; null where the block is empty
};

} // namespace heddle
