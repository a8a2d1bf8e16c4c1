#pragma once

#include <heddle/device/dense_sums.h>
#include <heddle/sggx/direction_sums.h>
#include <heddle/voxel/fit_block.h>

#include <cstdint>
#include <span>
#include <vector>

namespace heddle {

/// What LevelArrays of level 0 hold, on the host.
struct HostLevel {
    std::vector<std::uint64_t> key;
    std::vector<std::uint32_t> hits, first_lobe, order;
    std::vector<std::uint64_t> columns;
    std::vector<DirectionSums> lobes;
    std::vector<MapSums> maps;
};

/// The stored voxels of a batch's blocks, with columns and sums, one VoxelBlock a block.
[[nodiscard]] std::vector<VoxelBlock> blocks_from_level(const HostLevel& level,
                                                        std::span<const BatchBlock> blocks,
                                                        const FitOptions& options);

} // namespace heddle
