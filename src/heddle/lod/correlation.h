#pragma once

#include <heddle/lod/upper_levels.h>
#include <heddle/voxel/voxel_level.h>

#include <cstdint>
#include <span>
#include <vector>

namespace heddle {

/// Returns the correlation rho of the coverage of two voxels behind each other. With probability
/// rho, a ray that passes the first also passes the second, if the second covers no more.
///
/// rho = (c1 + c2 - c1 c2 - u) / (c1 + c2 - c1 c2 - max(c1, c2)), where u is the covered fraction
/// of the union of their columns. 0: independent (or negative); 1: one covers a part of what the
/// other covers.
/// @param first, second, both  covered columns of the first, of the second and of their union
/// @param columns              columns of a face
/// @return                     255 = 1; 255 also if a face is empty or full and rho is undefined
[[nodiscard]] std::uint8_t
correlation_of(std::int64_t first, std::int64_t second, std::int64_t both, double columns);

/// The columns of one block's voxels on one level, 3 x words per voxel, in the order of the stored
/// voxels.
using KeptColumns = std::vector<std::uint64_t>;

/// Fills VoxelBlock::correlation of a level up to kBlockLevel.
/// @param index    index of each block
/// @param blocks   stored voxels of each block, in whole leaves or in parts of leaves
/// @param kept     columns of each block
/// @param level    level of the voxels
/// @param columns  columns of a voxel's face
void fill_correlation(std::span<const Vec3i> index,
                      std::span<VoxelBlock> blocks,
                      std::span<const KeptColumns> kept,
                      int level,
                      double columns);

/// Fills VoxelBlock::correlation of a level above kBlockLevel.
/// @param index    index of each voxel
/// @param blocks   stored form of each voxel, or empty
/// @param kept     columns of each voxel; empty if there is none
/// @param columns  columns of a voxel's face
void fill_upper_correlation(std::span<const Vec3i> index,
                            std::span<VoxelBlock> blocks,
                            std::span<const std::array<UpperVoxel::Runs, 3>> kept,
                            double columns);

} // namespace heddle
