#pragma once

#include <heddle/base/bits.h>
#include <heddle/lod/open_level.h>
#include <heddle/voxel/lobe_pool.h>
#include <heddle/voxel/occupancy.h>

#include <cstddef>
#include <cstdint>

namespace heddle {

/// Marks the first child of each parent. Voxels with the same key >> 3 are consecutive.
struct MarkFirstChildOp {
    const std::uint64_t* key;
    std::uint8_t* first; ///< per voxel: 1 or 0

    HEDDLE_HD void operator()(std::size_t v) const {
        first[v] = v == 0 || key[v] >> 3 != key[v - 1] >> 3 ? 1 : 0;
    }
};

/// The data of each parent before its children are joined.
struct Parents {
    std::uint64_t* key;
    std::uint32_t* first_child; ///< number in the level below, and the end
    std::uint8_t* child_mask;   ///< bit x << 2 | y << 1 | z per existing child
};

/// Lists the parents; item `voxels` writes the end.
struct ListParentsOp {
    const std::uint64_t* key;
    const std::uint8_t* first;
    const std::uint32_t* parent; ///< of each voxel that is a first child
    std::size_t voxels;
    std::size_t parents;
    Parents out;

    HEDDLE_HD void operator()(std::size_t v) const {
        if (v == voxels) {
            out.first_child[parents] = static_cast<std::uint32_t>(voxels);
            return;
        }
        if (first[v] == 0) return;
        const std::uint32_t p = parent[v];
        out.key[p] = key[v] >> 3;
        out.first_child[p] = static_cast<std::uint32_t>(v);
        unsigned mask = 0;
        for (std::size_t c = v; c < voxels && key[c] >> 3 == key[v] >> 3; ++c) {
            mask |= 1u << (key[c] & 7);
        }
        out.child_mask[p] = static_cast<std::uint8_t>(mask);
    }
};

/// Merges the lobes of each parent's children in place. They are consecutive, child by child; the
/// remaining lobes are moved to the front.
struct MergeChildrenOp {
    const std::uint32_t* first_child;
    const std::uint32_t* first_lobe; ///< per child
    const std::uint32_t* child_hits;
    DirectionSums* lobes;
    MapSums* maps; ///< null: no map sums
    int max_lobes;
    std::uint32_t* hits;
    std::uint32_t* order;
    std::uint8_t* count; ///< number of remaining lobes

    HEDDLE_HD void operator()(std::size_t p) const {
        const std::uint32_t begin = first_child[p];
        const std::uint32_t end = first_child[p + 1];
        std::uint32_t sum = 0;
        for (std::uint32_t c = begin; c < end; ++c) sum += child_hits[c];
        hits[p] = sum;
        const std::uint32_t lobe = first_lobe[begin];
        LobeRow row{static_cast<int>(first_lobe[end] - lobe), lobes + lobe,
                    maps == nullptr ? nullptr : maps + lobe};
        order[p] = reduce(row, max_lobes, ByMoments{}, kSameLobe);
        count[p] = static_cast<std::uint8_t>(row.count);
    }
};

/// Joins the cells of each parent's children.
struct JoinOccupancyOp {
    const std::uint32_t* first_child;
    const std::uint8_t* child_mask;
    const std::uint64_t* below; ///< per child
    std::uint64_t* occupancy;

    HEDDLE_HD void operator()(std::size_t p) const {
        std::uint32_t child = first_child[p];
        std::uint64_t joined = 0;
        for (int octant = 0; octant < 8; ++octant) {
            if ((child_mask[p] >> octant & 1) == 0) continue;
            joined |= cells_in_parent(below[child++], octant);
        }
        occupancy[p] = joined;
    }
};

/// Copies the remaining lobes to the parents' arrays.
struct TakeLobesOp {
    const std::uint32_t* first_child; ///< null: a parent is its only child
    const std::uint32_t* lobe_below;  ///< per child: its first lobe
    const std::uint32_t* first_lobe;  ///< per parent, and the end
    const DirectionSums* from;
    const MapSums* maps_from; ///< null: no map sums
    DirectionSums* to;
    MapSums* maps_to;

    HEDDLE_HD void operator()(std::size_t p) const {
        const std::uint32_t source = lobe_below[first_child == nullptr ? p : first_child[p]];
        const std::uint32_t target = first_lobe[p];
        const std::uint32_t count = first_lobe[p + 1] - target;
        for (std::uint32_t k = 0; k < count; ++k) to[target + k] = from[source + k];
        if (maps_from == nullptr) return;
        for (std::uint32_t k = 0; k < count; ++k) maps_to[target + k] = maps_from[source + k];
    }
};

/// Joins columns, one item per word of a parent: along the axis, the words of two children are
/// OR-ed; across it, each pair fills a quarter.
struct JoinColumnsOp {
    const std::uint32_t* first_child;
    const std::uint8_t* child_mask;
    const std::uint64_t* below; ///< 3 x 4^(level - 1) words per voxel
    int level;                  ///< level of the parents
    std::uint64_t* columns;     ///< 3 x 4^level words per voxel

    HEDDLE_HD void operator()(std::size_t i) const {
        const int shift = 2 * (level - 1); // words of a child along an axis
        const std::size_t word = i & ((std::size_t{4} << shift) - 1);
        const std::size_t row = i >> (shift + 2);
        const std::size_t p = row / 3;
        const int axis = static_cast<int>(row % 3);
        const int place = static_cast<int>(word >> shift);
        const std::size_t at = word & ((std::size_t{1} << shift) - 1);
        std::uint64_t joined = 0;
        for (int half = 0; half < 2; ++half) {
            const int c = child_at(place, axis, half);
            const unsigned mask = child_mask[p];
            if ((mask >> c & 1u) == 0) continue;
            const std::size_t child =
                first_child[p] + static_cast<std::size_t>(count_bits(mask & ((1u << c) - 1)));
            joined |= below[((3 * child + static_cast<std::size_t>(axis)) << shift) + at];
        }
        columns[i] = joined;
    }

    /// Returns a child that fills a quarter of the columns along `axis`: the inverse of quarter().
    /// @param half  which of the two such children: 0 or 1 along the axis
    [[nodiscard]] HEDDLE_HD static constexpr int child_at(int place, int axis, int half) {
        const int p = axis == 0 ? 1 : 0;
        const int q = axis == 2 ? 1 : 2;
        return (place & 1) << (2 - p) | (place >> 1) << (2 - q) | half << (2 - axis);
    }
};

} // namespace heddle
