#include <heddle/lod/merge_children.h>

#include <heddle/base/random.h>
#include <heddle/sggx/moments.h>
#include <heddle/sggx/wasserstein.h>

#include <cmath>

namespace heddle {
namespace {

SymmetricMatrix scaled(const SymmetricMatrix& a, float s) {
    return {a.xx * s, a.yy * s, a.zz * s, a.xy * s, a.xz * s, a.yz * s};
}

SymmetricMatrix plus(const SymmetricMatrix& a, const SymmetricMatrix& b) {
    return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
}

/// Sets the moment of `sums` so that its mean by weight is `M`.
void set_moment(DirectionSums& sums, const SymmetricMatrix& M) {
    const auto w = static_cast<double>(sums.weight);
    const float entries[6]{M.xx, M.yy, M.zz, M.xy, M.xz, M.yz};
    for (int k = 0; k < 6; ++k) {
        sums.moment[k] = std::llround(static_cast<double>(entries[k]) * w);
    }
}

SymmetricMatrix outer(Vec3f d) {
    return {d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.x * d.z, d.y * d.z};
}

/// The lobes' shares of the pooled weight, and the kind that all lobes are converted to.
struct Shares {
    std::array<float, kMaxPool> of{};
    bool normals = false;
};

Shares share(LobePool& pool) {
    Shares shares;
    int heaviest = 0;
    double total = 0.0;
    for (int i = 0; i < pool.count; ++i) {
        const DirectionSums& lobe = pool.sums[static_cast<std::size_t>(i)];
        total += static_cast<double>(lobe.weight);
        if (lobe.weight > pool.sums[static_cast<std::size_t>(heaviest)].weight) heaviest = i;
    }
    shares.normals = pool.sums[static_cast<std::size_t>(heaviest)].normals;
    for (std::size_t i = 0; i < static_cast<std::size_t>(pool.count); ++i) {
        if (pool.sums[i].normals != shares.normals) pool.sums[i] = turned_across(pool.sums[i]);
        shares.of[i] = static_cast<float>(static_cast<double>(pool.sums[i].weight) / total);
    }
    return shares;
}

/// Merges the pool into one lobe with the moment finish(weighted mean of moment_of(child's
/// moment)).
template <typename MomentOf, typename Finish>
void merge_by_mean(LobePool& pool,
                   bool with_maps,
                   const MomentOf& moment_of,
                   const Finish& finish) {
    const Shares shares = share(pool);
    SymmetricMatrix sum;
    for (std::size_t i = 0; i < static_cast<std::size_t>(pool.count); ++i) {
        sum = plus(sum, scaled(moment_of(detail::mean_moment(pool.sums[i])), shares.of[i]));
    }
    reduce_by_moments(pool, 1, with_maps); // for weight, material and maps
    set_moment(pool.sums[0], finish(sum));
}

/// Replaces the pool by the heaviest lobe of one child, chosen at random.
void choose_child(LobePool& pool,
                  const std::array<int, 9>& first,
                  bool with_maps,
                  std::uint64_t seed) {
    int there[8];
    int count = 0;
    for (std::size_t c = 0; c < 8; ++c) {
        if (first[c] < first[c + 1]) there[count++] = first[c];
    }
    const auto pick = hash64(seed, 0) % static_cast<std::uint64_t>(count);
    const auto chosen = static_cast<std::size_t>(there[pick]);
    std::int64_t total = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(pool.count); ++i) {
        total += pool.sums[i].weight;
    }
    const SymmetricMatrix M = detail::mean_moment(pool.sums[chosen]);
    const std::int64_t part = pool.sums[chosen].weight;
    pool.sums[0] = pool.sums[chosen];
    pool.sums[0].weight = total;
    set_moment(pool.sums[0], M);
    if (with_maps) pool.maps[0] = scale_maps(pool.maps[chosen], total, part);
    pool.count = 1;
}

} // namespace

std::uint32_t merge_children(LobePool& pool,
                             const std::array<int, 9>& first,
                             const MergeOptions& options,
                             std::uint64_t seed) {
    const bool maps = options.with_maps;
    switch (options.method) {
    case LodMethod::Moments: return reduce_by_moments(pool, options.max_lobes, maps, kSameLobe);
    case LodMethod::Wasserstein:
        return reduce(pool, options.max_lobes, maps, [&](DirectionSums* lobes, int count) {
            return WassersteinLobes(std::span(lobes, static_cast<std::size_t>(count)), seed);
        });
    case LodMethod::Single: reduce_by_moments(pool, 1, maps); break;
    case LodMethod::Naive:
        merge_by_mean(
            pool, maps, [](const SymmetricMatrix& M) { return outer(principal_direction(M)); },
            [](const SymmetricMatrix& sum) { return outer(principal_direction(sum)); });
        break;
    case LodMethod::Random: choose_child(pool, first, maps, seed); break;
    case LodMethod::Interpolate:
        merge_by_mean(
            pool, maps, [](const SymmetricMatrix& M) { return fit_sggx(M); },
            [](const SymmetricMatrix& sum) { return second_moment_of(sum); });
        break;
    }
    return 0;
}

} // namespace heddle
