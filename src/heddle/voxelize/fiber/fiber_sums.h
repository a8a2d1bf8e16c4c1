#pragma once

#include <heddle/voxel/sum_fields.h>
#include <heddle/voxelize/block/accumulator.h>
#include <heddle/voxelize/chord/gather_chord.h>

#include <cstddef>
#include <cstdint>

namespace heddle {

/// The material and colour that a fiber adds to the voxels that it crosses.
struct FiberPaint {
    std::uint32_t material = 0;
    std::uint32_t color = 0xffffff; ///< linear RGB, added to the map sums if there are any
    bool last = false;              ///< FitMode::Last: replaces the direction instead of pooling
};

/// The block that chords are added to, and what they share.
struct GatherTarget {
    BlockSums& block;
    const LatticeUnits& units;
    int shift;  ///< log2 of the subvoxels per axis
    Vec3i size; ///< size of the block, voxels
    FiberPaint paint;
};

/// The sums of one voxel's lobe for pool_fiber(), and its map sums, or null if there are none.
struct LobeAdder {
    LobeSums& lobe;
    MapSums* maps;

    HEDDLE_HOST_INLINE void add_lobe(int, int field, std::int64_t x) const {
        sum_of(lobe, field) += x;
    }
    [[nodiscard]] HEDDLE_HOST_INLINE bool has_maps() const { return maps != nullptr; }
    HEDDLE_HOST_INLINE void add_map(int, int field, std::int64_t x) const {
        map_sum_of(*maps, field) += x;
    }
};

/// Pools directions in a voxel of a block by pool_fiber(); with FitMode::Last, replaces them.
HEDDLE_HOST_INLINE void pool_moment(BlockSums& block,
                                    VoxelSums& voxel,
                                    const float* moment,
                                    float weight,
                                    const FiberPaint& paint) {
    LobeSums& lobe = block.lobe(voxel, paint.material);
    if (paint.last) lobe = {.weight = 0, .material = lobe.material, .next = lobe.next};
    MapSums* maps = nullptr;
    if (block.has_maps()) {
        maps = &block.maps(voxel, lobe);
        if (paint.last) *maps = {};
    }
    pool_fiber(LobeAdder{lobe, maps}, 0, moment, weight, paint.color);
}

/// The sums of a block on the CPU that fibers of one material write to. DenseLobe is the
/// counterpart on the device.
struct FiberSums {
    BlockSums& block;
    const FiberPaint& paint;

    HEDDLE_HOST_INLINE VoxelSums& voxel(int cell) const {
        return block.voxel_at(static_cast<std::uint32_t>(cell));
    }
    HEDDLE_HOST_INLINE void or_column(int cell, int axis, std::uint64_t bits) const {
        voxel(cell).column[static_cast<std::size_t>(axis)] |= bits;
    }
    HEDDLE_HOST_INLINE void or_subvoxels(int cell, int word, std::uint64_t bits) const {
        voxel(cell).sub[static_cast<std::size_t>(word)] |= bits;
    }
    HEDDLE_HOST_INLINE void pool(int cell, const float* moment, float weight) const {
        pool_moment(block, voxel(cell), moment, weight, paint);
    }
};

} // namespace heddle
