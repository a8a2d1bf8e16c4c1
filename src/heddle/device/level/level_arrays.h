#pragma once

#include <heddle/executor/array.h>
#include <heddle/lod/open_level.h>
#include <heddle/sggx/direction_sums.h>
#include <heddle/voxel/voxel_level.h>

#include <cstddef>
#include <cstdint>

namespace heddle {

/// The voxels of one level in a batch of blocks, unquantized, in an executor's arrays. The level is
/// stored and the next level is built from them. They are in the order of `key`.
struct LevelArrays {
    int level = 0;
    std::size_t voxel_count = 0;
    std::size_t lobe_count = 0;
    /// per voxel: (slot of the block << 15 | position in Z-order (block_cell.h)) >> 3 level; that
    /// of a parent is key >> 3
    executor::Array<std::uint64_t> key;
    executor::Array<std::uint32_t> hits;       ///< per voxel: occupied subvoxels, at most 2^24
    executor::Array<std::uint32_t> first_lobe; ///< per voxel, and the end
    executor::Array<std::uint32_t> order;      ///< per voxel: VoxelBlock::merge_order
    executor::Array<std::uint64_t> occupancy;  ///< per voxel; with fields.occupancy only
    /// 3 x 4^level words per voxel, axis by axis, as in OpenLevel
    executor::Array<std::uint64_t> columns;
    executor::Array<DirectionSums> lobes;
    executor::Array<MapSums> maps;   ///< per lobe; with map sums only
    executor::Array<OpenSlab> slabs; ///< per voxel; with fields.slabs

    /// Returns the number of words along one axis of a voxel.
    [[nodiscard]] std::size_t words() const { return std::size_t{1} << (2 * level); }
};

} // namespace heddle
