#pragma once

#include <heddle/device/level/level_arrays.h>
#include <heddle/device/level/stored_level.h>
#include <heddle/lod/built_block.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace heddle {

/// What is built from a batch's level 0.
struct BatchOptions {
    FitOptions level0; ///< options of level 0; with fields.masks, columns and sums are stored
    FitOptions above;  ///< options of the levels above 0
    int levels = 0;    ///< number of levels above level 0, 0 to kBlockLevel
    bool top = false;  ///< return the voxels that levels above kBlockLevel are built from

    [[nodiscard]] bool with_maps() const { return level0.fields.map_sums(); }
};

/// Level kBlockLevel of a batch, at most one voxel per block, from which the levels above are
/// built.
struct TopLevel {
    HostBuffer<std::uint64_t> key; ///< slot of the block
    HostBuffer<std::uint32_t> hits, first_lobe, order;
    HostBuffer<std::uint64_t> columns;
    HostBuffer<std::uint64_t> occupancy; ///< empty without fields.occupancy
    HostBuffer<DirectionSums> lobes;
    HostBuffer<MapSums> maps;
    HostBuffer<OpenSlab> slabs;

    /// Returns a block's voxel; null if it has none.
    [[nodiscard]] std::unique_ptr<UpperVoxel> take(std::size_t slot) const;
};

/// Level 0 and the levels above it of a batch of blocks, on the host. Buffers are reused from batch
/// to batch.
struct BatchLevels {
    BatchOptions options;
    std::array<StoredLevel, kBlockLevel + 1> level;
    TopLevel top;

    /// Copies the levels of one block. Thread-safe.
    /// @param slot    number of the block in the batch
    /// @param index   index of the block
    /// @param level0  receives its voxels of level 0
    /// @param built   receives its levels above 0
    void cut(std::size_t slot, Vec3i index, VoxelBlock& level0, BuiltBlock& built) const;
};

/// Stores a batch's level 0, builds the levels above it and stores them. The result has the same
/// bits as that of LevelBuilder with the method `moments`. [docs/lod.md]
/// @param level0  is consumed
/// @param blocks  blocks of the batch
/// @throws Error  OutOfMemory, Device
template <typename Exec>
void build_batch_levels(Exec& exec,
                        LevelArrays level0,
                        std::size_t blocks,
                        const BatchOptions& options,
                        BatchLevels& out);

/// Returns the largest number of bytes that build_batch_levels() uses at once, including the arrays
/// of level 0, for any distribution of the voxels in the blocks.
/// @param voxels, lobes  counts of level 0
[[nodiscard]] std::int64_t predict_level_bytes(std::int64_t blocks,
                                               std::int64_t voxels,
                                               std::int64_t lobes,
                                               const BatchOptions& options);

} // namespace heddle
