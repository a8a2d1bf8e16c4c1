#pragma once

#include <heddle/device/level/host_buffer.h>
#include <heddle/voxel/voxel_level.h>
#include <heddle/voxelize/block/fit_options.h>

#include <cstddef>
#include <cstdint>

namespace heddle {

/// What is stored of a level's voxels in a batch of blocks, on the host: as in the arrays of
/// VoxelBlock, block after block.
struct StoredLevel {
    int level = 0;
    FitOptions options;
    HostBuffer<std::uint64_t> active;                  ///< 8 words a leaf (LeafCells)
    HostBuffer<std::uint32_t> first_voxel, first_lobe; ///< per leaf, and the end
    HostBuffer<Coverage> coverage;
    HostBuffer<std::uint8_t> lobe_count;
    HostBuffer<std::uint32_t> order; ///< per voxel; empty where K is below 3
    HostBuffer<Lobe> lobes;
    HostBuffer<LobeMaps> maps;           ///< per lobe; empty unless fields.maps()
    HostBuffer<PackedSggx> tangents;     ///< per lobe; empty unless fields.tangents
    HostBuffer<std::uint64_t> footprint; ///< 3 a voxel; empty without
    HostBuffer<std::uint64_t> columns;   ///< 3 a voxel; with fields.masks, level 0 alone
    HostBuffer<LobeMoment> moments;      ///< per lobe; with fields.masks
    HostBuffer<MapSums> map_sums;        ///< per lobe; with fields.masks and map sums

    /// A block's voxels: what the CPU's fit_block() or store_level() gives.
    /// @param slot   of the block in the batch
    /// @param index  of the block
    void cut(std::size_t slot, Vec3i index, VoxelBlock& out) const;
};

} // namespace heddle
