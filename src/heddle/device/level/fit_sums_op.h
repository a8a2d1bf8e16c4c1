#pragma once

#include <heddle/base/bits.h>
#include <heddle/device/level/block_cell.h>
#include <heddle/device/level/dense_sums.h>
#include <heddle/device/level/level_arrays.h>
#include <heddle/voxel/lobe_pool.h>
#include <heddle/voxel/occupancy.h>
#include <heddle/voxelize/block/fit_options.h>

#include <cstddef>
#include <cstdint>

namespace heddle {

/// The position of one voxel in a batch's sums.
struct SumsIndex {
    std::uint32_t slot = 0; ///< slot of the block
    int cell = -1;          ///< relative to the block's lo; < 0: outside of the block's range

    /// @param i  block x kVoxelsPerBlock + position in Z-order
    HEDDLE_HD SumsIndex(const BatchBlock* blocks, std::size_t i)
        : slot(static_cast<std::uint32_t>(i / kVoxelsPerBlock)) {
        const BatchBlock& block = blocks[slot];
        const Vec3i at = index_from_z_order(static_cast<std::uint32_t>(i % kVoxelsPerBlock)) +
                         block.index * kBlockVoxels - block.lo;
        const bool inside = at.x >= 0 && at.x < block.size.x && at.y >= 0 && at.y < block.size.y &&
                            at.z >= 0 && at.z < block.size.z;
        if (inside) cell = (at.x * kBlockVoxels + at.y) * kBlockVoxels + at.z;
    }
};

/// Counts voxel i of a batch, as 0 or 1, and its lobes, one per material.
struct CountVoxelOp {
    DenseSums sums;
    std::uint8_t* voxels;
    std::uint16_t* lobes;

    HEDDLE_HD void operator()(std::size_t i) const {
        const SumsIndex place(sums.blocks, i);
        int count = 0;
        if (place.cell >= 0) {
            const BatchBlock& block = sums.blocks[place.slot];
            for (std::uint32_t p = 0; p < block.planes; ++p) {
                const std::size_t at = std::size_t{block.first_plane + p} * kVoxelsPerBlock +
                                       static_cast<std::size_t>(place.cell);
                count += sums.weight_at(at) != 0 ? 1 : 0;
            }
        }
        voxels[i] = count > 0 ? 1 : 0;
        lobes[i] = static_cast<std::uint16_t>(count);
    }
};

/// Writes voxel i of a batch, if it is occupied, to its position in the level's arrays, with one
/// lobe per material.
struct FitVoxelOp {
    DenseSums sums;
    FitOptions options;
    std::size_t cells; ///< cells of the batch; item `cells` writes the end of the last lobes
    std::uint32_t voxel_count;
    const std::uint32_t* first_voxel; ///< per i, and the end
    const std::uint32_t* first_lobe;  ///< per i, and the end
    std::uint64_t* key;
    std::uint32_t* hits;
    std::uint32_t* lobe_begin;
    std::uint32_t* order;
    std::uint64_t* columns;
    std::uint64_t* occupancy; ///< null: not stored
    DirectionSums* lobes;
    MapSums* maps; ///< null without

    HEDDLE_HD void operator()(std::size_t i) const {
        if (i == cells) {
            lobe_begin[voxel_count] = first_lobe[cells];
            return;
        }
        const std::uint32_t v = first_voxel[i];
        if (first_voxel[i + 1] == v) return;
        const SumsIndex place(sums.blocks, i);
        const auto cell = static_cast<std::size_t>(place.cell);
        const std::uint64_t* masks =
            sums.masks + (std::size_t{place.slot} * kVoxelsPerBlock + cell) * DenseLobe::kMaskWords;
        key[v] = i;
        for (int axis = 0; axis < 3; ++axis) columns[std::size_t{3} * v + axis] = masks[axis];
        int count = 0;
        for (int w = 0; w < 8; ++w) count += count_bits(masks[DenseLobe::kSubvoxels + w]);
        hits[v] = static_cast<std::uint32_t>(count);
        if (occupancy != nullptr) {
            occupancy[v] = cells_of_voxel(masks + DenseLobe::kSubvoxels, masks, options.subvoxels);
        }
        lobe_begin[v] = first_lobe[i];
        order[v] = 0;
        write_lobes(sums.blocks[place.slot], cell, first_lobe[i]);
    }

private:
    /// Writes the lobes in the order of their materials, since the order of gathering is random.
    HEDDLE_HD void write_lobes(const BatchBlock& block, std::size_t cell, std::uint32_t to) const {
        std::uint32_t plane = block.first_plane;
        block.materials.for_each([&](std::uint32_t material) {
            const std::size_t at = std::size_t{plane++} * kVoxelsPerBlock + cell;
            if (sums.weight_at(at) == 0) return;
            lobes[to] = lobe_at(material, at);
            if (maps != nullptr) {
                maps[to] = *reinterpret_cast<const MapSums*>(sums.maps + at * DenseLobe::kMapWords);
            }
            ++to;
        });
    }
    HEDDLE_HD DirectionSums lobe_at(std::uint32_t material, std::size_t at) const {
        DirectionSums out;
        const std::uint64_t* words = sums.lobes + at * DenseLobe::kLobeWords;
        for (int k = 0; k < 6; ++k) {
            out.moment[k] = static_cast<std::int64_t>(words[LobeField::Moment + k]);
        }
        out.weight = static_cast<std::int64_t>(words[LobeField::Weight]);
        out.material = material;
        out.normals = options.normals.has(material);
        return out;
    }
};

/// Merges the lobes of one voxel in place until as many are left as may be stored, and orders them.
struct MergeLobesOp {
    const std::uint32_t* first_lobe; ///< per voxel, and the end
    DirectionSums* lobes;
    MapSums* maps; ///< null: no map sums
    int max_lobes;
    std::uint32_t* order;
    std::uint8_t* count; ///< number of remaining lobes

    HEDDLE_HD void operator()(std::size_t v) const {
        const std::uint32_t begin = first_lobe[v];
        const auto all = static_cast<int>(first_lobe[v + 1] - begin);
        LobeRow row{0, lobes + begin, maps == nullptr ? nullptr : maps + begin};
        for (int next = 0; next < all; ++next) { // reduce whenever the pool is full
            if (row.count == kMaxPool) reduce(row, kMaxLobes, ByMoments{});
            row.sums[row.count] = row.sums[next];
            if (row.maps != nullptr) row.maps[row.count] = row.maps[next];
            ++row.count;
        }
        order[v] = reduce(row, max_lobes, ByMoments{});
        count[v] = static_cast<std::uint8_t>(row.count);
    }
};

} // namespace heddle
