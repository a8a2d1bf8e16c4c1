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
    std::array<MapSums, kMaxPool> maps; ///< meaningless unless the grid has map sums

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

/// The sums of a lobe whose weight goes from `part` to `whole`, means unchanged.
[[nodiscard]] MapSums scale_maps(const MapSums& maps, std::int64_t whole, std::int64_t part);

/// Lobes that lie in a row, before they are stored: of a LobePool, or where an executor keeps them.
struct LobeRow {
    int count = 0;                 ///< at most kMaxPool
    DirectionSums* sums = nullptr; ///< the first
    MapSums* maps = nullptr;       ///< the first one's; null without
};

namespace detail {

/// Puts each of the first `count` values where `place` says, by a copy.
template <typename T>
HEDDLE_INLINE void permute(T* values, int count, const std::uint8_t (&place)[kMaxLobes]) {
    T before[kMaxLobes];
    for (int i = 0; i < count; ++i) before[i] = values[i];
    for (int i = 0; i < count; ++i) values[place[i]] = before[i];
}

} // namespace detail

/// Lines up at most kMaxLobes lobes as a voxel stores them: the heaviest first, the others so that
/// the last one merges first.
/// @param make_lobes  (DirectionSums*, int count) -> how lobes are compared and merged
///                    (agglomerate.h)
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

/// Merges the closest of the lobes until `keep` are left, at most kMaxLobes, moves those to the
/// front and lines them up.
/// @param row   count becomes how many are left
/// @param same  distance below which lobes merge even so (agglomerate.h)
/// @return      as order_lobes
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

/// The same of a pool.
/// @param with_maps  pool.maps count
template <typename MakeLobes>
HEDDLE_INLINE std::uint32_t
reduce(LobePool& pool, int keep, bool with_maps, const MakeLobes& make_lobes, float same = 0.0f) {
    LobeRow row{pool.count, pool.sums.data(), with_maps ? pool.maps.data() : nullptr};
    const std::uint32_t order = reduce(row, keep, make_lobes, same);
    pool.count = row.count;
    return order;
}

/// The default way of reduce(): by second moments.
struct ByMoments {
    HEDDLE_INLINE MomentLobes operator()(DirectionSums* lobes, int count) const {
        return MomentLobes(std::span(lobes, static_cast<std::size_t>(count)));
    }
};

/// reduce() by second moments, compiled for the machine's vectors.
std::uint32_t reduce_by_moments(LobePool& pool, int keep, bool with_maps, float same = 0.0f);

/// Fits that were just made: the voxels that one flat triangle passes alone have few different
/// sums.
class RecentFits {
public:
    [[nodiscard]] PackedSggx fit(const std::int64_t (&moment)[6], std::int64_t weight);

private:
    static constexpr int kBits = 8;
    struct Entry {
        std::int64_t moment[6]{};
        std::int64_t weight = 0; ///< no lobe's: they weigh 1 or more
        PackedSggx sggx;
    };
    std::array<Entry, std::size_t{1} << kBits> entries_;
};

/// Appends the voxel's lobes, at most kMaxLobes, to the block's arrays of lobes and its count: S is
/// fitted and packed here and nowhere before.
/// @param order  of reduce() or order_lobes()
void append_lobes(const LobePool& pool,
                  std::uint32_t order,
                  const VoxelFields& fields,
                  RecentFits& fits,
                  VoxelBlock& out);

} // namespace heddle
