#pragma once

#include <heddle/base/platform.h>
#include <heddle/voxel/sum_fields.h>
#include <heddle/voxelize/block/accumulator.h>

#include <cstddef>
#include <cstdint>

namespace heddle {

/// The sums of one material in a block, for BlockTarget (surface_hits.h).
class MaterialSums {
public:
    /// @param last  true: only the last hit counts (FitMode::Last)
    HEDDLE_INLINE MaterialSums(BlockSums& block, std::uint32_t material, bool last)
        : block_(block), material_(material), last_(last), has_maps_(block.has_maps()) {}

    // the last voxel is cached, since consecutive hits are mostly in the same voxel
    HEDDLE_INLINE void or_column(int cell, int axis, std::uint64_t bits) {
        if (cell != cell_) open(cell);
        voxel_->column[static_cast<std::size_t>(axis)] |= bits;
    }
    HEDDLE_INLINE void or_subvoxels(int, int word, std::uint64_t bits) {
        voxel_->sub[static_cast<std::size_t>(word)] |= bits;
    }
    HEDDLE_INLINE void add_lobe(int, int field, std::int64_t x) { sum_of(*lobe_, field) += x; }
    HEDDLE_INLINE void add_map(int, int field, std::int64_t x) { map_sum_of(*maps_, field) += x; }
    [[nodiscard]] HEDDLE_INLINE bool has_maps() const { return has_maps_; }
    HEDDLE_INLINE bool forget(int) {
        if (!last_) return false;
        *lobe_ = {.weight = 0, .material = lobe_->material, .next = lobe_->next};
        if (has_maps_) *maps_ = {};
        return true;
    }

private:
    HEDDLE_INLINE void open(int cell) {
        cell_ = cell;
        voxel_ = &block_.voxel_at(static_cast<std::uint32_t>(cell));
        lobe_ = &block_.lobe(*voxel_, material_);
        if (has_maps_) maps_ = &block_.maps(*voxel_, *lobe_);
    }

    BlockSums& block_;
    std::uint32_t material_;
    bool last_, has_maps_;
    int cell_ = -1;
    VoxelSums* voxel_ = nullptr;
    LobeSums* lobe_ = nullptr;
    MapSums* maps_ = nullptr;
};

} // namespace heddle
