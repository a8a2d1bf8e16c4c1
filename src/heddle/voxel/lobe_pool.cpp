#include <heddle/voxel/lobe_pool.h>

#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>

namespace heddle {
namespace {

SymmetricMatrix to_moment(const std::int64_t (&sums)[6], std::int64_t weight) {
    const double inv = 1.0 / static_cast<double>(weight);
    const auto entry = [&](std::size_t i) {
        return static_cast<float>(static_cast<double>(sums[i]) * inv);
    };
    return {entry(0), entry(1), entry(2), entry(3), entry(4), entry(5)};
}

std::uint8_t mean8(std::int64_t sum, std::int64_t weight) {
    return static_cast<std::uint8_t>(std::clamp<std::int64_t>((sum + weight / 2) / weight, 0, 255));
}

LobeMaps mean_maps(const MapSums& sums, std::int64_t weight) {
    LobeMaps mean;
    for (std::size_t i = 0; i < 3; ++i) mean.albedo[i] = mean8(sums.albedo[i], weight);
    mean.roughness = mean8(sums.roughness, weight);
    mean.metalness = mean8(sums.metalness, weight);
    mean.anisotropy = mean8(sums.anisotropy, weight);
    return mean;
}

PackedSggx fit_tangents(const MapSums& sums) {
    std::int64_t moment[6];
    std::copy_n(sums.tangent.begin(), 6, moment);
    const std::int64_t trace = moment[0] + moment[1] + moment[2];
    return trace > 0 ? pack(fit_sggx(to_moment(moment, trace))) : PackedSggx{};
}

} // namespace

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
        entry.sggx = pack(fit_sggx(to_moment(moment, weight)));
    }
    return entry.sggx;
}

void append_lobes(const LobePool& pool,
                  std::uint32_t order,
                  const VoxelGridFields& fields,
                  RecentFits& fits,
                  VoxelBlock& out) {
    std::int64_t total = 0;
    const auto count = static_cast<std::size_t>(pool.count);
    for (std::size_t i = 0; i < count; ++i) total += pool.sums[i].weight;
    for (std::size_t i = 0; i < count; ++i) {
        const DirectionSums& lobe = pool.sums[i];
        const auto share = static_cast<double>(lobe.weight) / static_cast<double>(total);
        out.lobes.push_back(
            {fits.fit(lobe.moment, lobe.weight),
             static_cast<std::uint8_t>(std::max(1, static_cast<int>(share * 255.0 + 0.5))),
             static_cast<std::uint8_t>(lobe.material)});
        if (fields.maps()) out.maps.push_back(mean_maps(pool.maps[i], lobe.weight));
        if (fields.tangents) out.tangents.push_back(fit_tangents(pool.maps[i]));
    }
    out.lobe_count.push_back(static_cast<std::uint8_t>(count));
    if (count > 2 && out.merge_order.empty()) out.merge_order.resize(out.lobe_count.size() - 1);
    if (count > 2 || !out.merge_order.empty()) out.merge_order.push_back(order);
}

} // namespace heddle
