#pragma once

#include <heddle/voxel/voxel_level.h>

#include <vector>

namespace heddle {

/// Blocks of 32^3 voxels out of pieces that hold parts of leaves, each voxel in one of them. The
/// pieces are taken apart.
[[nodiscard]] std::vector<VoxelBlock> join_pieces(std::vector<VoxelBlock> pieces);

} // namespace heddle
