#pragma once

#include <heddle/base/platform.h>
#include <heddle/device/level/block_cell.h>
#include <heddle/executor/atomic.h>
#include <heddle/voxel/material_set.h>
#include <heddle/voxel/sum_fields.h>
#include <heddle/voxelize/chord/gather_chord.h>

#include <cstddef>
#include <cstdint>

namespace heddle {

/// The sums of one material in one block, for executors: the counterpart of FiberSums on the CPU,
/// with sums for every voxel. All additions are atomic and of integers.
struct DenseLobe {
    static constexpr int kMaskWords = 12; ///< columns along x, y, z; 8 of subvoxels; one spare
    static constexpr int kSubvoxels = 3;  ///< the first mask word of subvoxels
    static constexpr int kLobeWords = LobeField::Count + 1; ///< and one spare
    static constexpr int kMapWords = MapField::Count;

    std::uint64_t* masks = nullptr; ///< kMaskWords per voxel (x 32 + y) 32 + z
    std::uint64_t* lobes = nullptr; ///< kLobeWords per voxel, two's complement
    std::uint64_t* maps = nullptr;  ///< kMapWords per voxel; null: no map sums
    std::uint32_t color = 0xffffff; ///< colour of the fiber

    HEDDLE_HD void or_column(int cell, int axis, std::uint64_t bits) const {
        executor::atomic_or(masks + cell * kMaskWords + axis, bits);
    }
    /// @param word  word of the voxel's subvoxels, which are bits (x n + y) n + z of all words
    HEDDLE_HD void or_subvoxels(int cell, int word, std::uint64_t bits) const {
        executor::atomic_or(masks + cell * kMaskWords + kSubvoxels + word, bits);
    }
    HEDDLE_HD void add_lobe(int cell, int field, std::int64_t x) const {
        executor::atomic_add(lobes + cell * kLobeWords + field, static_cast<std::uint64_t>(x));
    }
    [[nodiscard]] HEDDLE_HD bool has_maps() const { return maps != nullptr; }
    HEDDLE_HD void add_map(int cell, int field, std::int64_t x) const {
        executor::atomic_add(maps + cell * kMapWords + field, static_cast<std::uint64_t>(x));
    }
    HEDDLE_HD void pool(int cell, const float* moment, float weight) const {
        pool_fiber(*this, cell, moment, weight, color);
    }
};

/// A block of a batch and its range of voxels. It is uploaded as it is.
struct BatchBlock {
    Vec3i index;    ///< index of the block
    Vec3i lo, size; ///< first voxel; voxels per axis, fewer than 32 if a region clips it
    std::uint32_t first_plane = 0; ///< first plane of its lobes; one plane per material
    std::uint32_t planes = 0;
    MaterialSet materials; ///< materials of its primitives
};
static_assert(sizeof(BatchBlock) == 80);

/// The sums of a batch of blocks.
struct DenseSums {
    const BatchBlock* blocks = nullptr;
    std::uint64_t* masks = nullptr; ///< block by block, kVoxelsPerBlock voxels each
    std::uint64_t* lobes = nullptr; ///< plane by plane, kVoxelsPerBlock voxels each
    std::uint64_t* maps = nullptr;  ///< plane by plane; null: no map sums

    /// Returns the plane of a material in a block. The block must have the material.
    [[nodiscard]] HEDDLE_HD static std::uint32_t plane_of(const BatchBlock& block,
                                                          std::uint32_t material) {
        return block.first_plane + block.materials.count_below(material);
    }
    /// Returns the weight of a lobe; 0 if there is none.
    /// @param at  plane x kVoxelsPerBlock + cell
    [[nodiscard]] HEDDLE_HD std::uint64_t weight_at(std::size_t at) const {
        return lobes[at * DenseLobe::kLobeWords + LobeField::Weight];
    }
    [[nodiscard]] HEDDLE_HD DenseLobe lobe(std::uint32_t slot, std::uint32_t material) const {
        const std::size_t plane = std::size_t{plane_of(blocks[slot], material)} * kVoxelsPerBlock;
        DenseLobe out;
        out.masks = masks + std::size_t{slot} * kVoxelsPerBlock * DenseLobe::kMaskWords;
        out.lobes = lobes + plane * DenseLobe::kLobeWords;
        if (maps != nullptr) out.maps = maps + plane * DenseLobe::kMapWords;
        return out;
    }
    /// Returns the bytes of a batch's sums.
    [[nodiscard]] static constexpr std::int64_t
    byte_count(std::int64_t blocks, std::int64_t planes, bool with_maps) {
        return std::int64_t{kVoxelsPerBlock} * 8 *
               (blocks * DenseLobe::kMaskWords +
                planes * (DenseLobe::kLobeWords + (with_maps ? DenseLobe::kMapWords : 0)));
    }
};

} // namespace heddle
