#pragma once

#include <heddle/device/level/level_arrays.h>
#include <heddle/device/level/stored_level.h>
#include <heddle/lod/built_block.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace heddle {

/// What is made of a batch's level 0.
struct BatchOptions {
    FitOptions level0; ///< with fields.masks: columns and sums too
    FitOptions above;  ///< of levels above 0
    int levels = 0;    ///< above level 0, 0 to kBlockLevel
    bool top = false;  ///< what levels above kBlockLevel are built from is wanted

    [[nodiscard]] bool with_maps() const { return level0.fields.map_sums(); }
};

/// Level kBlockLevel of a batch as the levels above it take it: at most one voxel a block.
struct TopLevel {
    HostBuffer<std::uint64_t> key; ///< slot of the block
    HostBuffer<std::uint32_t> hits, first_lobe, order;
    HostBuffer<std::uint64_t> columns;
    HostBuffer<DirectionSums> lobes;
    HostBuffer<MapSums> maps;

    /// A block's voxel; null where it has none.
    [[nodiscard]] std::unique_ptr<UpperVoxel> take(std::size_t slot) const;
};

/// Level 0 and the levels above it of a batch of blocks, on the host; buffers are kept from batch
/// to batch.
struct BatchLevels {
    BatchOptions options;
    std::array<StoredLevel, kBlockLevel + 1> level;
    TopLevel top;

    /// Takes a block out of it. Safe from several threads.
    /// @param slot    of the block in the batch
    /// @param index   of the block
    /// @param level0  becomes its voxels
    /// @param built   becomes its levels above 0
    void cut(std::size_t slot, Vec3i index, VoxelBlock& level0, BuiltBlock& built) const;
};

/// Stores a batch's level 0, builds the levels above it and stores them: as LevelBuilder does by
/// the method `moments`, bit for bit.                                               [docs/lod.md]
/// @param level0  is used up
/// @param blocks  of the batch
/// @throws Error  OutOfMemory, Device
template <typename Exec>
void build_batch_levels(Exec& exec,
                        LevelArrays level0,
                        std::size_t blocks,
                        const BatchOptions& options,
                        BatchLevels& out);

/// Bytes that build_batch_levels() has in use at once, at most, level 0's arrays included: however
/// voxels lie in the blocks.
/// @param voxels, lobes  of level 0
[[nodiscard]] std::int64_t predict_level_bytes(std::int64_t blocks,
                                               std::int64_t voxels,
                                               std::int64_t lobes,
                                               const BatchOptions& options);

} // namespace heddle
