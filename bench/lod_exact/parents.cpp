#include "parents.h"

#include <heddle/base/parallel.h>
#include <heddle/base/platform.h>
#include <heddle/base/random.h>
#include <heddle/sggx/pack.h>
#include <heddle/voxel/leaf_voxels.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace heddle::bench {
namespace {

constexpr std::uint64_t kSeed = 4;  ///< seed for choosing voxels
constexpr std::size_t kShares = 32; ///< parts of the chosen voxels, for threads
constexpr std::size_t kGrain = 64 * 1024;

std::uint64_t hash_of(Vec3i at) {
    const auto word = [](std::int32_t x) { return std::uint64_t{static_cast<std::uint32_t>(x)}; };
    return hash64(kSeed, word(at.x) << 32 | word(at.y), word(at.z));
}

void add_moment(PooledMoment& sum, const std::array<std::int64_t, 6>& moment, double weight) {
    for (std::size_t k = 0; k < 6; ++k) sum.moment[k] += static_cast<double>(moment[k]);
    sum.weight += weight;
}

double moment_error(const PooledMoment& pooled, const std::vector<MixtureLobe>& lobes) {
    std::array<double, 6> sum{};
    double total = 0.0;
    for (const MixtureLobe& lobe : lobes) {
        const SymmetricMatrix M = second_moment_of(lobe.S);
        const float entries[6]{M.xx, M.yy, M.zz, M.xy, M.xz, M.yz};
        for (std::size_t k = 0; k < 6; ++k) sum[k] += lobe.weight * static_cast<double>(entries[k]);
        total += lobe.weight;
    }
    double worst = 0.0;
    for (std::size_t k = 0; k < 6; ++k) {
        worst = std::max(worst, std::fabs(sum[k] / total - pooled.moment[k] / pooled.weight));
    }
    return worst;
}

/// Adds the directions `numbers`. This takes nine tenths of the time: inlined, AVX2 too.
HEDDLE_CLONES __attribute__((flatten)) void
add_directions(std::span<const Directed> directions,
               const std::vector<std::uint32_t>& numbers,
               const std::vector<std::uint32_t>& found,
               std::vector<DirectionTruth>& truths) {
    for (const std::uint32_t i : numbers) {
        const Directed& d = directions[i];
        truths[found[i] * kKinds + static_cast<std::size_t>(d.kind)].add(
            to_double(d.d), static_cast<double>(d.weight));
    }
}

double median_of(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double greatest_of(const std::vector<double>& values) {
    return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

} // namespace

Parents::Parents(const VoxelLevel& level, std::size_t most) : level_(level.info().level) {
    Vec3i hi;
    for (int a = 0; a < 3; ++a) {
        lo_[a] = std::numeric_limits<std::int32_t>::max();
        hi[a] = std::numeric_limits<std::int32_t>::min();
    }
    for_each_voxel(level, [&](const BlockVoxel& v) {
        voxels_.push_back(v.at);
        for (int a = 0; a < 3; ++a) {
            lo_[a] = std::min(lo_[a], v.at[a]);
            hi[a] = std::max(hi[a], v.at[a] + 1);
        }
    });
    there_ = voxels_.size();
    size_ = hi - lo_;
    number_.assign(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
                       static_cast<std::size_t>(size_.z),
                   kNotThere);
    const auto cell = [&](Vec3i at) -> std::uint32_t& {
        const Vec3i p = at - lo_;
        return number_[(static_cast<std::size_t>(p.x) * static_cast<std::size_t>(size_.y) +
                        static_cast<std::size_t>(p.y)) *
                           static_cast<std::size_t>(size_.z) +
                       static_cast<std::size_t>(p.z)];
    };
    for (const Vec3i& at : voxels_) cell(at) = kNotChosen;
    std::sort(voxels_.begin(), voxels_.end(),
              [](Vec3i a, Vec3i b) { return hash_of(a) < hash_of(b); });
    voxels_.resize(std::min(most, voxels_.size()));
    for (std::size_t i = 0; i < voxels_.size(); ++i)
        cell(voxels_[i]) = static_cast<std::uint32_t>(i);
    truths_.resize(voxels_.size() * kKinds);
    pooled_.resize(voxels_.size() * kKinds);
}

std::uint32_t Parents::find(Vec3i at) const {
    const Vec3i p = at - lo_;
    if (p.x < 0 || p.y < 0 || p.z < 0 || p.x >= size_.x || p.y >= size_.y || p.z >= size_.z) {
        return kNotThere;
    }
    return number_[(static_cast<std::size_t>(p.x) * static_cast<std::size_t>(size_.y) +
                    static_cast<std::size_t>(p.y)) *
                       static_cast<std::size_t>(size_.z) +
                   static_cast<std::size_t>(p.z)];
}

void Parents::add(std::span<const Directed> directions) {
    found_.resize(directions.size());
    parallel_chunks(directions.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Vec3i at = directions[i].voxel;
            found_[i] = find({at.x >> level_, at.y >> level_, at.z >> level_});
        }
    });
    std::array<std::vector<std::uint32_t>, kShares> share;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const auto weight = static_cast<double>(directions[i].weight);
        total_ += weight;
        if (found_[i] == kNotThere) lost_ += weight;
        if (found_[i] >= kNotChosen) continue;
        share[found_[i] % kShares].push_back(static_cast<std::uint32_t>(i));
    }
    parallel_chunks(kShares, 1, [&](std::size_t s, std::size_t) {
        add_directions(directions, share[s], found_, truths_);
    });
}

void Parents::add_below(const Parents& below) {
    for (std::size_t i = 0; i < below.size(); ++i) {
        const Vec3i at = below.voxels_[i];
        const std::uint32_t to = find({at.x >> 1, at.y >> 1, at.z >> 1});
        if (to >= kNotChosen) continue;
        for (std::size_t kind = 0; kind < kKinds; ++kind) {
            const DirectionTruth& from = below.truths_[i * kKinds + kind];
            DirectionTruth& sum = truths_[to * kKinds + kind];
            for (std::size_t k = 0; k < sum.sigma.size(); ++k) sum.sigma[k] += from.sigma[k];
            for (std::size_t k = 0; k < sum.cell.size(); ++k) sum.cell[k] += from.cell[k];
            for (std::size_t k = 0; k < sum.moment.size(); ++k) sum.moment[k] += from.moment[k];
            sum.weight += from.weight;
        }
    }
    lost_ = below.lost_;
    total_ = below.total_;
}

void Parents::pool(const VoxelLevel& finest) {
    const bool tangents = finest.info().fields.tangents;
    for_each_voxel(finest, [&](const BlockVoxel& v) {
        const std::uint32_t to = find({v.at.x >> level_, v.at.y >> level_, v.at.z >> level_});
        if (to >= kNotChosen) return;
        PooledMoment* sums = &pooled_[to * kKinds];
        for (std::size_t i = v.lobe; i < v.lobe + v.lobe_count(); ++i) {
            const LobeMoment& m = v.block.moments[i];
            add_moment(sums[0], m.moment, static_cast<double>(m.weight));
            if (!tangents) continue;
            const std::array<std::int64_t, 6>& t = v.block.map_sums[i].tangent;
            add_moment(sums[1], t, static_cast<double>(t[0] + t[1] + t[2]));
        }
    });
}

std::vector<Mixture> decode(const VoxelLevel& level, const Parents& parents) {
    std::vector<Mixture> mixtures(parents.size());
    for_each_voxel(level, [&](const BlockVoxel& v) {
        const std::uint32_t to = parents.find(v.at);
        if (to >= Parents::kNotChosen) return;
        const VoxelBlock& block = v.block;
        for (std::size_t i = v.lobe; i < v.lobe + v.lobe_count(); ++i) {
            const auto weight = static_cast<double>(block.lobes[i].weight);
            mixtures[to].lobes[0].push_back({unpack(block.lobes[i].sggx), weight});
            if (block.tangents.empty() || block.tangents[i].sigma[0] == 0) continue;
            const double strength = level.info().fields.surface ? block.maps[i].anisotropy : 255.0;
            if (!(strength > 0.0)) continue;
            mixtures[to].lobes[1].push_back({unpack(block.tangents[i]), weight * strength});
        }
    });
    return mixtures;
}

LevelErrors measure(const std::vector<Mixture>& mixtures, const Parents& parents, Kind kind) {
    const std::size_t n = mixtures.size();
    std::vector<DirectionError> errors(n);
    std::vector<double> pooled(n);
    std::vector<std::uint8_t> there(n);
    parallel_chunks(n, 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto& lobes = mixtures[i].lobes[static_cast<std::size_t>(kind)];
            const DirectionTruth& truth = parents.truth(i, kind);
            if (lobes.empty() || !(truth.weight > 0.0)) continue;
            there[i] = 1;
            errors[i] = mixture_error(lobes, truth);
            pooled[i] = moment_error(parents.pooled(i, kind), lobes);
        }
    });
    LevelErrors out;
    std::vector<double> moment, against_sums;
    double all = 0.0;
    double over = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        if (there[i] == 0) continue;
        ++out.count;
        moment.push_back(errors[i].moment);
        against_sums.push_back(pooled[i]);
        out.sigma += errors[i].sigma;
        out.cells += errors[i].cells;
        const double weight = parents.truth(i, kind).weight;
        all += weight;
        if (!(errors[i].moment > kMomentGoal)) continue;
        ++out.over;
        over += weight;
    }
    if (out.count == 0) return out;
    out.over_share = over / all;
    out.sigma /= static_cast<double>(out.count);
    out.cells /= static_cast<double>(out.count);
    out.moment_max = greatest_of(moment);
    out.moment_median = median_of(std::move(moment));
    out.pooled_max = greatest_of(against_sums);
    out.pooled_median = median_of(std::move(against_sums));
    return out;
}

} // namespace heddle::bench
