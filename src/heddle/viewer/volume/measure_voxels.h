#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/bounds.h>
#include <heddle/voxel/voxel_level.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace heddle::viewer {

inline constexpr int kMaxVoxelLevels = 24;    ///< the number that shaders have room for
inline constexpr int kBlockShift = 5;         ///< a block is a cube of 32^3 of the finest voxels
inline constexpr std::size_t kLeafWords = 21; ///< active: 16, before: 4, first voxel: 1

/// The memory of a level on the driver, by storage block.
struct VoxelTableBytes {
    std::int64_t cells = 0;      ///< 4 per cell of 16^3 leaves, occupied or not
    std::int64_t leaf_table = 0; ///< 16 KiB per occupied cell
    std::int64_t leaves = 0;     ///< 84 per leaf
    std::int64_t voxels = 0;     ///< 4 per voxel, in each of three storage blocks

    [[nodiscard]] std::int64_t total() const { return cells + leaf_table + leaves + 3 * voxels; }
    /// Bytes of the largest storage block.
    [[nodiscard]] std::int64_t largest() const;
    VoxelTableBytes& operator+=(const VoxelTableBytes& other);
};

/// The measurements of a level, before its tables are made.
struct VoxelMeasure {
    VoxelTableBytes bytes;
    Bounds bounds;             ///< of its voxels, scene units
    std::vector<Vec3i> cells;  ///< of 16^3 leaves, occupied
    std::vector<Vec3i> blocks; ///< of 4^3 leaves, occupied
};

/// Reads the leaves of all blocks; advances `progress` by one per block.
/// @throws Error  Cancelled
[[nodiscard]] VoxelMeasure measure_voxels(const VoxelLevel& source, Progress& progress);

} // namespace heddle::viewer
