#pragma once

#include <heddle/base/platform.h>
#include <heddle/sggx/merge_order.h>
#include <heddle/sggx/moment_lobes.h>
#include <heddle/voxel/voxel_level.h>

#include <algorithm>
#include <array>
#include <span>

namespace heddle {

/// The lobes of one voxel, or of several that become one, before they are stored.
struct LobePool {
    int count = 0; ///< at most kMaxPool
    std::array<DirectionSums, kMaxPool> sums;
    std::array<MapSums, kMaxPool> maps; ///< unspecified unless the level has map sums

    HEDDLE_HD void add(const DirectionSums& lobe, const MapSums* lobe_maps) {
        const auto at = static_cast<std::size_t>(count++);
        sums[at] = lobe;
        if (lobe_maps != nullptr) maps[at] = *lobe_maps;
    }
};

/// a += b, sum by sum.
HEDDLE_INLINE void add_maps(MapSums& a, const MapSums& b) {
    for (std::size_t i = 0; i < 6; ++i) a.tangent[i] += b.tangent[i];
    for (std::size_t i = 0; i < 3; ++i) a.albedo[i] += b.albedo[i];
    a.roughness += b.roughness;
    a.metalness += b.metalness;
    a.anisotropy += b.anisotropy;
}

/// Returns the sums of a lobe whose weight changes from `part` to `whole` with the same means.
[[nodiscard]] MapSums scale_maps(const MapSums& maps, std::int64_t whole, std::int64_t part);

/// Consecutive lobes before they are stored, in a LobePool or in an executor's arrays.
struct LobeRow {
    int count = 0;                 ///< at most kMaxPool
    DirectionSums* sums = nullptr; ///< first of `count`
    MapSums* maps = nullptr;       ///< first of `count`; null: no map sums
};

namespace detail {

/// Moves each of the first `count` values i to place[i].
template <typename T>
HEDDLE_INLINE void permute(T* values, int count, const std::uint8_t (&place)[kMaxLobes]) {
    T before[kMaxLobes];
    for (int i = 0; i < count; ++i) before[i] = values[i];
    for (int i = 0; i < count; ++i) values[place[i]] = before[i];
}

} // namespace detail

/// Orders at most kMaxLobes lobes as a voxel stores them: the heaviest first, and the others so
/// that the last one merges first.
/// @param make_lobes  make_lobes(DirectionSums*, int count) returns an object that compares and
///                    merges the lobes (agglomerate.h)
/// @return            VoxelBlock::merge_order
template <typename MakeLobes>
HEDDLE_INLINE std::uint32_t order_lobes(const LobeRow& row, const MakeLobes& make_lobes) {
    if (row.count < 2) return 0;
    std::int64_t weight[kMaxLobes];
    for (int i = 0; i < row.count; ++i) weight[i] = row.sums[i].weight;
    LobeMerge merges[kMaxLobes];
    if (row.count == 2) {
        merges[0] = {0, 1};
    } else {
        DirectionSums merging[kMaxLobes];
        for (int i = 0; i < row.count; ++i) merging[i] = row.sums[i];
        auto lobes = make_lobes(merging, row.count);
        agglomerate(row.count, 1, lobes, merges);
    }
    const MergeOrder order = order_merges(row.count, merges, weight);
    detail::permute(row.sums, row.count, order.place);
    if (row.maps != nullptr) detail::permute(row.maps, row.count, order.place);
    return order.targets;
}

/// Merges the closest lobes until at most `keep` are left, moves those to the front and orders them
/// as order_lobes() does.
/// @param row   its count becomes the number of lobes that are left
/// @param keep  at most kMaxLobes
/// @param same  lobes closer than this merge even if no more than `keep` are left (agglomerate.h)
/// @return      VoxelBlock::merge_order
template <typename MakeLobes>
HEDDLE_INLINE std::uint32_t
reduce(LobeRow& row, int keep, const MakeLobes& make_lobes, float same = 0.0f) {
    if (row.count > keep || (row.count > 1 && same > 0.0f)) {
        LobeMerge merges[kMaxPool];
        auto lobes = make_lobes(row.sums, row.count);
        const int made = agglomerate(row.count, keep, lobes, merges, same);
        const auto count = static_cast<std::size_t>(row.count);
        if (row.maps != nullptr) {
            for (int k = 0; k < made; ++k) {
                add_maps(row.maps[merges[k].into], row.maps[merges[k].from]);
            }
            compact_lobes(std::span(row.maps, count), merges, made);
        }
        row.count = compact_lobes(std::span(row.sums, count), merges, made);
    }
    return order_lobes(row, make_lobes);
}

/// Does the same for a pool.
/// @param with_maps  pool.maps is reduced too
template <typename MakeLobes>
HEDDLE_INLINE std::uint32_t
reduce(LobePool& pool, int keep, bool with_maps, const MakeLobes& make_lobes, float same = 0.0f) {
    LobeRow row{pool.count, pool.sums.data(), with_maps ? pool.maps.data() : nullptr};
    const std::uint32_t order = reduce(row, keep, make_lobes, same);
    pool.count = row.count;
    return order;
}

/// The default `make_lobes` of reduce(): lobes are compared by their second moments.
struct ByMoments {
    HEDDLE_INLINE MomentLobes operator()(DirectionSums* lobes, int count) const {
        return MomentLobes(std::span(lobes, static_cast<std::size_t>(count)));
    }
};

/// Does reduce() by second moments, compiled for the vector instructions of the machine.
std::uint32_t reduce_by_moments(LobePool& pool, int keep, bool with_maps, float same = 0.0f);

/// A cache of recent fits: voxels that only one flat triangle crosses have few different sums.
class RecentFits {
public:
    /// Returns fit_packed(moment, weight), from the cache if it has it.
    [[nodiscard]] PackedSggx fit(const std::int64_t (&moment)[6], std::int64_t weight);

private:
    static constexpr int kBits = 8;
    struct Entry {
        std::int64_t moment[6]{};
        std::int64_t weight = 0; ///< 0: an empty entry, since lobes have a weight of 1 or more
        PackedSggx sggx;
    };
    std::array<Entry, std::size_t{1} << kBits> entries_;
};

/// Appends a voxel's lobes, at most kMaxLobes, and their count to the block's arrays. S is fitted
/// and packed here.
/// @param order  result of reduce() or order_lobes()
void append_lobes(const LobePool& pool,
                  std::uint32_t order,
                  const VoxelFields& fields,
                  RecentFits& fits,
                  VoxelBlock& out);

} // namespace heddle
