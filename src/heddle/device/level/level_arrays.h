#pragma once

#include <heddle/executor/array.h>
#include <heddle/sggx/direction_sums.h>
#include <heddle/voxel/voxel_level.h>

#include <cstddef>
#include <cstdint>

namespace heddle {

/// The voxels of one level in a batch of blocks, unquantized, where an executor works: what is
/// stored of the level, and what the next one is built from. In the order of `key`.
struct LevelArrays {
    int level = 0;
    std::size_t voxel_count = 0;
    std::size_t lobe_count = 0;
    /// per voxel: (number of the block in the batch << 15 | place in Z-order (block_cell.h)) >> 3
    /// level: a parent's is key >> 3
    executor::Array<std::uint64_t> key;
    executor::Array<std::uint32_t> hits;       ///< per voxel: subvoxels, at most 2^24 at level 5
    executor::Array<std::uint32_t> first_lobe; ///< per voxel, and the end
    executor::Array<std::uint32_t> order;      ///< per voxel: VoxelBlock::merge_order
    /// per voxel 3 x 4^level words, axis by axis, as OpenLevel
    executor::Array<std::uint64_t> columns;
    executor::Array<DirectionSums> lobes;
    executor::Array<MapSums> maps; ///< per lobe; with map sums only

    /// Words along one axis of a voxel.
    [[nodiscard]] std::size_t words() const { return std::size_t{1} << (2 * level); }
};

} // namespace heddle
