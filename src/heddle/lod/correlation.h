#pragma once

#include <heddle/lod/upper_levels.h>
#include <heddle/voxel/voxel_level.h>

#include <cstdint>
#include <span>
#include <vector>

namespace heddle {

/// How far two voxels behind each other hide the same: with that probability a ray that was let
/// through by the first is let through by the second whenever it covers no more.
///
/// rho = (c1 + c2 - c1 c2 - u) / (c1 + c2 - c1 c2 - max(c1, c2)), u the covered share of the union
/// of their columns: 0 independent (or less), 1 the one inside the other.   [findings: threshold
/// transport]
/// @param first, second, both  columns set in either and in the union
/// @param columns              of a face
/// @return                     255 = 1; 255 where a face is empty or full, and rho means nothing
[[nodiscard]] std::uint8_t
correlation_of(std::int64_t first, std::int64_t second, std::int64_t both, double columns);

/// The columns of one block's voxels at one level, 3 x words each, in the order of the stored
/// voxels.
using KeptColumns = std::vector<std::uint64_t>;

/// Fills VoxelBlock::correlation of a level up to kBlockLevel.
/// @param index    of each block
/// @param blocks   stored voxels of each, whole leaves or parts
/// @param kept     columns of each
/// @param level    of the voxels
/// @param columns  of a voxel's face
void fill_correlation(std::span<const Vec3i> index,
                      std::span<VoxelBlock> blocks,
                      std::span<const KeptColumns> kept,
                      int level,
                      double columns);

/// The same for a level above kBlockLevel.
/// @param index   of each voxel
/// @param blocks  stored form of each, or empty
/// @param kept    columns of each, empty where there is no voxel
void fill_upper_correlation(std::span<const Vec3i> index,
                            std::span<VoxelBlock> blocks,
                            std::span<const std::array<UpperVoxel::Runs, 3>> kept,
                            double columns);

} // namespace heddle
