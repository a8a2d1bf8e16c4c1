#include <heddle/voxel/lobe_pool.h>

#include <heddle/voxel/stored_lobe.h>

namespace heddle {
MapSums scale_maps(const MapSums& maps, std::int64_t whole, std::int64_t part) {
    const double factor = static_cast<double>(whole) / static_cast<double>(part);
    const auto scale = [&](std::int64_t x) {
        return static_cast<std::int64_t>(static_cast<double>(x) * factor);
    };
    MapSums out;
    for (std::size_t i = 0; i < 6; ++i) out.tangent[i] = scale(maps.tangent[i]);
    for (std::size_t i = 0; i < 3; ++i) out.albedo[i] = scale(maps.albedo[i]);
    out.roughness = scale(maps.roughness);
    out.metalness = scale(maps.metalness);
    out.anisotropy = scale(maps.anisotropy);
    return out;
}

HEDDLE_CLONES std::uint32_t
reduce_by_moments(LobePool& pool, int keep, bool with_maps, float same) {
    return reduce(pool, keep, with_maps, ByMoments{}, same);
}

PackedSggx RecentFits::fit(const std::int64_t (&moment)[6], std::int64_t weight) {
    std::uint64_t h = static_cast<std::uint64_t>(weight);
    for (const std::int64_t m : moment) {
        h = (h ^ static_cast<std::uint64_t>(m)) * 0x9e3779b97f4a7c15u;
    }
    Entry& entry = entries_[h >> (64 - kBits)];
    if (entry.weight != weight || !std::equal(moment, moment + 6, entry.moment)) {
        std::copy_n(moment, 6, entry.moment);
        entry.weight = weight;
        entry.sggx = fit_packed(moment, weight);
    }
    return entry.sggx;
}

void append_lobes(const LobePool& pool,
                  std::uint32_t order,
                  const VoxelFields& fields,
                  RecentFits& fits,
                  VoxelBlock& out) {
    std::int64_t total = 0;
    const auto count = static_cast<std::size_t>(pool.count);
    for (std::size_t i = 0; i < count; ++i) total += pool.sums[i].weight;
    for (std::size_t i = 0; i < count; ++i) {
        const DirectionSums& lobe = pool.sums[i];
        out.lobes.push_back({fits.fit(lobe.moment, lobe.weight), share_of(lobe.weight, total),
                             static_cast<std::uint8_t>(lobe.material)});
        if (fields.maps()) out.maps.push_back(mean_maps(pool.maps[i], lobe.weight));
        if (fields.tangents) out.tangents.push_back(fit_tangents(pool.maps[i]));
    }
    out.lobe_count.push_back(static_cast<std::uint8_t>(count));
    if (count > 2 && out.merge_order.empty()) out.merge_order.resize(out.lobe_count.size() - 1);
    if (count > 2 || !out.merge_order.empty()) out.merge_order.push_back(order);
}

} // namespace heddle
