#pragma once

#include <heddle/device/level/host_buffer.h>
#include <heddle/voxel/voxel_level.h>
#include <heddle/voxelize/block/fit_options.h>

#include <cstddef>
#include <cstdint>

namespace heddle {

/// The stored form of a level's voxels in a batch of blocks, on the host, with the arrays of
/// VoxelBlock, block after block.
struct StoredLevel {
    int level = 0;
    FitOptions options;
    HostBuffer<std::uint64_t> active;                  ///< 8 words per leaf (LeafCells)
    HostBuffer<std::uint32_t> first_voxel, first_lobe; ///< per leaf, and the end
    HostBuffer<Coverage> coverage;
    HostBuffer<std::uint8_t> lobe_count;
    HostBuffer<std::uint32_t> order; ///< per voxel; empty if K is below 3
    HostBuffer<Lobe> lobes;
    HostBuffer<LobeMaps> maps;           ///< per lobe; empty unless fields.maps()
    HostBuffer<PackedSggx> tangents;     ///< per lobe; empty unless fields.tangents
    HostBuffer<std::uint64_t> footprint; ///< 3 per voxel; with fields.footprints
    HostBuffer<std::uint64_t> occupancy; ///< per voxel; with fields.occupancy
    HostBuffer<std::uint64_t> columns;   ///< 3 per voxel; with fields.masks, level 0 only
    HostBuffer<LobeMoment> moments;      ///< per lobe; with fields.masks
    HostBuffer<MapSums> map_sums;        ///< per lobe; with fields.masks and map sums
    HostBuffer<PlaneSlab> slabs;         ///< per voxel; with fields.slabs

    /// Copies a block's voxels, as the CPU's fit_block() or store_level() makes them.
    /// @param slot   number of the block in the batch
    /// @param index  index of the block
    void cut(std::size_t slot, Vec3i index, VoxelBlock& out) const;
};

} // namespace heddle
