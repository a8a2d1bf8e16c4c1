#pragma once

#include <heddle/base/platform.h>
#include <heddle/sggx/merge_order.h>
#include <heddle/sggx/moment_lobes.h>
#include <heddle/voxel/voxel_grid.h>

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

/// Lines up at most kMaxLobes lobes as a voxel stores them: the heaviest first, the others so that the
/// last one merges first.
/// @param make_lobes  (DirectionSums*, int count) -> how lobes are compared and merged (agglomerate.h)
/// @param with_maps   pool.maps count
/// @return            VoxelBlock::merge_order
template <typename MakeLobes>
HEDDLE_INLINE std::uint32_t line_up(LobePool& pool, bool with_maps, const MakeLobes& make_lobes) {
    if (pool.count < 2) return 0;
    const auto count = static_cast<std::size_t>(pool.count);
    std::array<DirectionSums, kMaxLobes> sums;
    std::array<std::int64_t, kMaxLobes> weight;
    std::copy_n(pool.sums.begin(), count, sums.begin());
    for (std::size_t i = 0; i < count; ++i) weight[i] = sums[i].weight;
    std::array<LobeMerge, kMaxLobes> merges;
    if (count == 2) {
        merges[0] = {0, 1};
    } else {
        auto lobes = make_lobes(sums.data(), pool.count);
        agglomerate(pool.count, 1, lobes, merges.data());
    }
    const MergeOrder order = order_merges(pool.count, merges.data(), weight.data());
    std::copy_n(pool.sums.begin(), count, sums.begin());
    for (std::size_t i = 0; i < count; ++i) pool.sums[order.place[i]] = sums[i];
    if (with_maps) {
        std::array<MapSums, kMaxLobes> maps;
        std::copy_n(pool.maps.begin(), count, maps.begin());
        for (std::size_t i = 0; i < count; ++i) pool.maps[order.place[i]] = maps[i];
    }
    return order.targets;
}

/// Merges the pool's closest lobes until `keep` are left, at most kMaxLobes, and lines them up.
/// @param same  distance below which lobes merge even so (agglomerate.h)
/// @return      as line_up
template <typename MakeLobes>
HEDDLE_INLINE std::uint32_t
reduce(LobePool& pool, int keep, bool with_maps, const MakeLobes& make_lobes, float same = 0.0f) {
    if (pool.count > keep || (pool.count > 1 && same > 0.0f)) {
        std::array<LobeMerge, kMaxPool> merges;
        auto lobes = make_lobes(pool.sums.data(), pool.count);
        const int made = agglomerate(pool.count, keep, lobes, merges.data(), same);
        if (with_maps) {
            for (int k = 0; k < made; ++k) {
                const LobeMerge& m = merges[static_cast<std::size_t>(k)];
                add_maps(pool.maps[m.into], pool.maps[m.from]);
            }
        }
        const auto count = static_cast<std::size_t>(pool.count);
        if (with_maps) compact_lobes(std::span(pool.maps).first(count), merges.data(), made);
        pool.count = compact_lobes(std::span(pool.sums).first(count), merges.data(), made);
    }
    return line_up(pool, with_maps, make_lobes);
}

/// The default way of reduce() and line_up(): by second moments.
struct ByMoments {
    HEDDLE_INLINE MomentLobes operator()(DirectionSums* lobes, int count) const {
        return MomentLobes(std::span(lobes, static_cast<std::size_t>(count)));
    }
};

/// reduce() by second moments, compiled for the machine's vectors.
std::uint32_t reduce_by_moments(LobePool& pool, int keep, bool with_maps, float same = 0.0f);

/// Fits that were just made: the voxels that one flat triangle passes alone have few different sums.
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
/// @param order  of reduce() or line_up()
void append_lobes(const LobePool& pool,
                  std::uint32_t order,
                  const VoxelGridFields& fields,
                  RecentFits& fits,
                  VoxelBlock& out);

} // namespace heddle
