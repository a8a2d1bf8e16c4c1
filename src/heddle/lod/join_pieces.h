#pragma once

#include <heddle/voxel/voxel_level.h>

#include <vector>

namespace heddle {

/// Returns blocks of 32^3 voxels, joined from pieces that hold parts of leaves. Each voxel is in
/// one piece only. The pieces are consumed.
[[nodiscard]] std::vector<VoxelBlock> join_pieces(std::vector<VoxelBlock> pieces);

} // namespace heddle
