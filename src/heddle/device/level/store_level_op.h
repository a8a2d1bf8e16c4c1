#pragma once

#include <heddle/base/bits.h>
#include <heddle/device/level/block_cell.h>
#include <heddle/executor/atomic.h>
#include <heddle/sggx/direction_sums.h>
#include <heddle/voxel/footprint.h>
#include <heddle/voxel/stored_lobe.h>

#include <cstddef>
#include <cstdint>

namespace heddle {

/// The positions of a level's voxels in a batch's leaves: cubes of 8^3 voxels from the block's
/// corner, or the whole block if it is smaller. Leaves are ordered by block and then by ascending
/// x, y, z, as are the voxels of a leaf.
struct LeafCells {
    int level = 0;

    /// Returns the number of leaves along a block's edge.
    [[nodiscard]] HEDDLE_HD constexpr int edge() const { return level < 2 ? 4 >> level : 1; }
    [[nodiscard]] HEDDLE_HD constexpr std::size_t per_block() const {
        return static_cast<std::size_t>(edge() * edge() * edge());
    }
    /// The leaf of a voxel, and the voxel's bit in it.
    struct LeafPosition {
        std::size_t leaf;
        int x;   ///< number of the word
        int bit; ///< 8 y + z
    };
    [[nodiscard]] HEDDLE_HD LeafPosition place(std::uint64_t key) const {
        const int shift = 15 - 3 * level;
        const std::uint64_t cell = key & ((std::uint64_t{1} << shift) - 1);
        const Vec3i at = index_from_z_order(static_cast<std::uint32_t>(cell));
        const int leaf = ((at.x >> 3) * edge() + (at.y >> 3)) * edge() + (at.z >> 3);
        return {static_cast<std::size_t>(key >> shift) * per_block() +
                    static_cast<std::size_t>(leaf),
                at.x & 7, (at.y & 7) * 8 + (at.z & 7)};
    }
};

/// Sets each leaf's bits.
struct MarkLeavesOp {
    LeafCells cells;
    const std::uint64_t* key;
    std::uint64_t* active; ///< 8 words per leaf

    HEDDLE_HD void operator()(std::size_t v) const {
        const LeafCells::LeafPosition at = cells.place(key[v]);
        executor::atomic_or(active + 8 * at.leaf + at.x, std::uint64_t{1} << at.bit);
    }
};

/// Counts each leaf's voxels.
struct CountLeavesOp {
    const std::uint64_t* active;
    std::uint32_t* count;

    HEDDLE_HD void operator()(std::size_t leaf) const {
        int sum = 0;
        for (std::size_t x = 0; x < 8; ++x) sum += count_bits(active[8 * leaf + x]);
        count[leaf] = static_cast<std::uint32_t>(sum);
    }
};

/// Finds the stored position of each voxel.
struct RankVoxelsOp {
    LeafCells cells;
    const std::uint64_t* key;
    const std::uint64_t* active;
    const std::uint32_t* first_voxel; ///< per leaf
    const std::uint32_t* first_lobe;  ///< per voxel
    std::uint32_t* voxel_at;          ///< per stored voxel: its number in the level
    std::uint8_t* lobe_count;         ///< per stored voxel

    HEDDLE_HD void operator()(std::size_t v) const {
        const LeafCells::LeafPosition at = cells.place(key[v]);
        const std::uint64_t* words = active + 8 * at.leaf;
        int before = count_bits(words[at.x] & ((std::uint64_t{1} << at.bit) - 1));
        for (int x = 0; x < at.x; ++x) before += count_bits(words[x]);
        const std::uint32_t rank = first_voxel[at.leaf] + static_cast<std::uint32_t>(before);
        voxel_at[rank] = static_cast<std::uint32_t>(v);
        lobe_count[rank] = static_cast<std::uint8_t>(first_lobe[v + 1] - first_lobe[v]);
    }
};

/// Finds each leaf's first lobe; item `leaves` writes the end.
struct FirstLobesOp {
    const std::uint32_t* first_voxel; ///< per leaf, and the end
    const std::uint32_t* lobe_begin;  ///< per stored voxel, and the end
    std::uint32_t* first_lobe;

    HEDDLE_HD void operator()(std::size_t leaf) const {
        first_lobe[leaf] = lobe_begin[first_voxel[leaf]];
    }
};

/// Computes coverage and footprint of a stored voxel along one axis: item 3 x voxel + axis.
struct StoreFaceOp {
    int level;
    int subvoxels;  ///< per voxel axis of level 0
    int footprints; ///< cells per axis; 0: none
    const std::uint32_t* voxel_at;
    const std::uint32_t* hits;
    const std::uint64_t* columns;
    Coverage* coverage;
    std::uint64_t* footprint; ///< 3 a voxel

    HEDDLE_HD void operator()(std::size_t i) const {
        const std::size_t rank = i / 3;
        const auto axis = static_cast<int>(i % 3);
        const std::size_t v = voxel_at[rank];
        const std::size_t words = std::size_t{1} << (2 * level);
        const std::uint64_t* row = columns + (3 * v + static_cast<std::size_t>(axis)) * words;
        std::int64_t covered = 0;
        for (std::size_t w = 0; w < words; ++w) covered += count_bits(row[w]);
        const std::int64_t n = std::int64_t{subvoxels} << level;
        Coverage& out = coverage[rank];
        const std::uint16_t share = fraction16(covered, n * n);
        if (axis == 0) {
            out.x = share;
            out.occupancy = fraction16(hits[v], n * n * n);
        } else if (axis == 1) {
            out.y = share;
        } else {
            out.z = share;
        }
        if (footprints == 0) return;
        Footprint face(level, subvoxels);
        for (std::size_t w = 0; w < words; ++w) face.add(w, row[w]);
        footprint[i] = face.bits(footprints);
    }
};

/// Writes the occupancy of a stored voxel.
struct StoreOccupancyOp {
    const std::uint32_t* voxel_at;
    const std::uint64_t* from; ///< per voxel
    std::uint64_t* occupancy;

    HEDDLE_HD void operator()(std::size_t rank) const { occupancy[rank] = from[voxel_at[rank]]; }
};

/// Writes the lobes of a stored voxel: S is fitted and packed.
struct StoreLobesOp {
    const std::uint32_t* voxel_at;
    const std::uint32_t* first_lobe; ///< per voxel, and the end
    const std::uint32_t* lobe_begin; ///< per stored voxel
    const std::uint32_t* order_from; ///< per voxel
    const DirectionSums* sums;
    const MapSums* map_sums; ///< null: no map sums
    std::uint32_t* order;    ///< per stored voxel; null: not stored
    Lobe* lobes;
    LobeMaps* maps;       ///< null: not stored
    PackedSggx* tangents; ///< null: not stored

    HEDDLE_HD void operator()(std::size_t rank) const {
        const std::size_t v = voxel_at[rank];
        const std::uint32_t begin = first_lobe[v];
        const std::uint32_t count = first_lobe[v + 1] - begin;
        if (order != nullptr) order[rank] = order_from[v];
        std::int64_t total = 0;
        for (std::uint32_t k = 0; k < count; ++k) total += sums[begin + k].weight;
        for (std::uint32_t k = 0; k < count; ++k) {
            const DirectionSums& from = sums[begin + k];
            const std::uint32_t to = lobe_begin[rank] + k;
            lobes[to] = {fit_packed(from.moment, from.weight), share_of(from.weight, total),
                         static_cast<std::uint8_t>(from.material)};
            if (maps != nullptr) maps[to] = mean_maps(map_sums[begin + k], from.weight);
            if (tangents != nullptr) tangents[to] = fit_tangents(map_sums[begin + k]);
        }
    }
};

/// Writes the columns and sums of a stored voxel of level 0.
struct StoreSumsOp {
    const std::uint32_t* voxel_at;
    const std::uint32_t* first_lobe; ///< per voxel, and the end
    const std::uint32_t* lobe_begin; ///< per stored voxel
    const std::uint64_t* columns_from;
    const DirectionSums* sums;
    const MapSums* maps_from; ///< null: no map sums
    std::uint64_t* columns;   ///< 3 per voxel
    LobeMoment* moments;
    MapSums* maps;

    HEDDLE_HD void operator()(std::size_t rank) const {
        const std::size_t v = voxel_at[rank];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            columns[3 * rank + axis] = columns_from[3 * v + axis];
        }
        const std::uint32_t begin = first_lobe[v];
        const std::uint32_t count = first_lobe[v + 1] - begin;
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::uint32_t to = lobe_begin[rank] + k;
            for (std::size_t m = 0; m < 6; ++m) {
                moments[to].moment[m] = sums[begin + k].moment[m];
            }
            moments[to].weight = sums[begin + k].weight;
            if (maps_from != nullptr) maps[to] = maps_from[begin + k];
        }
    }
};

} // namespace heddle
