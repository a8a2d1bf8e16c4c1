#pragma once

#include <heddle/voxel/sum_fields.h>
#include <heddle/voxelize/block/accumulator.h>
#include <heddle/voxelize/chord/gather_chord.h>

#include <cstddef>
#include <cstdint>

namespace heddle {

/// What a fiber leaves in the voxels that it passes.
struct FiberPaint {
    std::uint32_t material = 0;
    std::uint32_t color = 0xffffff; ///< linear RGB, goes to the map sums where there are some
    bool last = false;              ///< FitMode::Last: replaces the direction instead of pooling
};

/// Where chords go: what all of a run share.
struct GatherTarget {
    BlockSums& block;
    const LatticeUnits& units;
    int shift;  ///< log2 of the subvoxels per axis
    Vec3i size; ///< of the block
    FiberPaint paint;
};

/// Sums of one voxel's lobe, and of its maps where there are some (else null), as pool_fiber()
/// adds.
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

/// Pools directions in a voxel of a block: pool_fiber(), or with FitMode::Last in its place.
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

/// What fibers of one material write to, over a block of the CPU: DenseSums is its twin on the
/// device.
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
