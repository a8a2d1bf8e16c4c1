#include <heddle/voxel/fit_block.h>

#include <heddle/base/trig.h>
#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace heddle {
namespace {

constexpr int kLeaf = 8;
constexpr int kLeaves = kBlockVoxels / kLeaf;

std::uint16_t fraction16(int part, int whole) {
    return static_cast<std::uint16_t>((part * 65535 + whole / 2) / whole);
}

/// Columns along each axis that hold a hit subvoxel.                       [Fabre26, 3.5]
std::array<std::uint64_t, 3> project(const VoxelSums& voxel, int n) {
    std::array<std::uint64_t, 3> column{};
    for (int bit = 0; bit < n * n * n; ++bit) {
        if ((voxel.sub[static_cast<std::size_t>(bit >> 6)] >> (bit & 63) & 1u) == 0) continue;
        const int z = bit % n;
        const int y = bit / n % n;
        const int x = bit / (n * n);
        column[0] |= std::uint64_t{1} << (z * n + y);
        column[1] |= std::uint64_t{1} << (z * n + x);
        column[2] |= std::uint64_t{1} << (y * n + x);
    }
    return column;
}

HEDDLE_INLINE int hit_subvoxels(const VoxelSums& voxel, int n) {
    const int words = (n * n * n + 63) / 64;
    int hits = 0;
    for (int i = 0; i < words; ++i) hits += std::popcount(voxel.sub[static_cast<std::size_t>(i)]);
    return hits;
}

HEDDLE_INLINE Coverage coverage_of(const VoxelSums& voxel, const FitOptions& options, int hits) {
    const int n = options.subvoxels;
    const std::array<std::uint64_t, 3> column =
        options.project_subvoxels ? project(voxel, n) : voxel.column;
    return {fraction16(std::popcount(column[0]), n * n),
            fraction16(std::popcount(column[1]), n * n),
            fraction16(std::popcount(column[2]), n * n), fraction16(hits, n * n * n)};
}

SymmetricMatrix to_moment(const std::array<std::int64_t, 6>& sums, std::int64_t weight) {
    const double inv = 1.0 / static_cast<double>(weight);
    const auto entry = [&](std::size_t i) {
        return static_cast<float>(static_cast<double>(sums[i]) * inv);
    };
    return {entry(0), entry(1), entry(2), entry(3), entry(4), entry(5)};
}

/// Fits that were just made: the voxels that one flat triangle passes alone have few different sums.
class RecentFits {
public:
    HEDDLE_INLINE PackedSggx fit(const LobeSums& lobe) {
        std::uint64_t h = static_cast<std::uint64_t>(lobe.weight);
        for (const std::int64_t m : lobe.moment) {
            h = (h ^ static_cast<std::uint64_t>(m)) * 0x9e3779b97f4a7c15u;
        }
        Entry& entry = entries_[h >> (64 - kBits)];
        if (entry.weight != lobe.weight || entry.moment != lobe.moment) {
            entry = {lobe.moment, lobe.weight, pack(fit_sggx(to_moment(lobe.moment, lobe.weight)))};
        }
        return entry.sggx;
    }

private:
    static constexpr int kBits = 8;
    struct Entry {
        std::array<std::int64_t, 6> moment{};
        std::int64_t weight = 0; ///< no lobe's: they weigh 1 or more
        PackedSggx sggx;
    };
    std::array<Entry, std::size_t{1} << kBits> entries_;
};

/// What a block's voxels share while they are fitted.
struct BlockFit {
    const BlockSums& sums;
    const FitOptions& options;
    VoxelBlock& out;
    std::vector<const LobeSums*> order{};
    RecentFits fits{};
};

std::uint8_t mean8(std::int64_t sum, std::int64_t weight) {
    return static_cast<std::uint8_t>(std::clamp<std::int64_t>((sum + weight / 2) / weight, 0, 255));
}

HEDDLE_INLINE void
append_lobe(BlockFit& fit, const VoxelSums& voxel, const LobeSums& lobe, std::int64_t total) {
    const auto& [sums, options, out, order, fits] = fit;
    const auto share = static_cast<double>(lobe.weight) / static_cast<double>(total);
    out.lobes.push_back(
        {fit.fits.fit(lobe),
         static_cast<std::uint8_t>(std::max(1, static_cast<int>(share * 255.0 + 0.5))),
         static_cast<std::uint8_t>(lobe.material)});
    const MapSums* maps = sums.find_maps(voxel, lobe);
    if (options.fields.albedo || options.fields.surface) {
        LobeMaps mean;
        if (maps != nullptr) {
            for (std::size_t i = 0; i < 3; ++i)
                mean.albedo[i] = mean8(maps->albedo[i], lobe.weight);
            mean.roughness = mean8(maps->roughness, lobe.weight);
            mean.metalness = mean8(maps->metalness, lobe.weight);
            mean.anisotropy = mean8(maps->anisotropy, lobe.weight);
        }
        out.maps.push_back(mean);
    }
    if (options.fields.tangents) {
        PackedSggx tangent;
        if (maps != nullptr) {
            const std::int64_t trace = maps->tangent[0] + maps->tangent[1] + maps->tangent[2];
            if (trace > 0) tangent = pack(fit_sggx(to_moment(maps->tangent, trace)));
        }
        out.tangents.push_back(tangent);
    }
}

HEDDLE_INLINE std::int64_t append_voxel(BlockFit& fit, const VoxelSums& voxel) {
    auto& [sums, options, out, order, fits] = fit;
    const int hits = hit_subvoxels(voxel, options.subvoxels);
    out.coverage.push_back(coverage_of(voxel, options, hits));
    order.clear();
    for (const LobeSums* l = &voxel.lobe; l != nullptr; l = sums.next(*l)) order.push_back(l);
    std::sort(order.begin(), order.end(), [](const LobeSums* a, const LobeSums* b) {
        return a->weight != b->weight ? a->weight > b->weight : a->material < b->material;
    });
    if (order.size() > static_cast<std::size_t>(options.max_lobes)) {
        order.resize(static_cast<std::size_t>(options.max_lobes));
    }
    std::int64_t total = 0;
    for (const LobeSums* l : order) total += l->weight;
    for (const LobeSums* l : order) append_lobe(fit, voxel, *l, total);
    out.lobe_count.push_back(static_cast<std::uint8_t>(order.size()));
    return hits;
}

/// True when a row of a leaf, all of it inside the block, has no voxel: most rows of a surface.
HEDDLE_INLINE bool is_empty_row(const std::uint16_t* slots) {
    static_assert(BlockSums::kNone == 0xffff);
    std::uint64_t words[2];
    std::memcpy(words, slots, sizeof words);
    return (words[0] & words[1]) == ~std::uint64_t{0};
}

/// Appends a leaf's voxels.
/// @param base  the leaf's corner relative to the block's lo: a region's block may start inside it
/// @return      hit subvoxels
HEDDLE_INLINE std::int64_t append_leaf(BlockFit& fit, Vec3i base, VoxelLeaf& leaf) {
    const BlockSums& sums = fit.sums;
    const Vec3i size = sums.hi() - sums.lo();
    const int z_begin = std::max(0, base.z);
    const int z_end = std::min(size.z, base.z + kLeaf);
    std::int64_t hits = 0;
    for (int x = std::max(0, base.x); x < std::min(size.x, base.x + kLeaf); ++x) {
        for (int y = std::max(0, base.y); y < std::min(size.y, base.y + kLeaf); ++y) {
            const std::uint16_t* slots = sums.slots(x, y);
            if (z_end - z_begin == kLeaf && is_empty_row(slots + z_begin)) continue;
            for (int z = z_begin; z < z_end; ++z) {
                if (slots[z] == BlockSums::kNone) continue;
                const int bit = (y - base.y) * kLeaf + (z - base.z);
                leaf.active[static_cast<std::size_t>(x - base.x)] |= std::uint64_t{1} << bit;
                hits += append_voxel(fit, sums.at_slot(slots[z]));
            }
        }
    }
    return hits;
}

} // namespace

HEDDLE_CLONES BlockCounts fit_block(const BlockSums& sums,
                                    const FitOptions& options,
                                    VoxelBlock& out) {
    constexpr int kAcross = kLeaves + 1;
    BlockCounts counts;
    BlockFit fit{sums, options, out};
    const Vec3i lo = sums.lo();
    const Vec3i first{floor_div(lo.x, kLeaf), floor_div(lo.y, kLeaf), floor_div(lo.z, kLeaf)};
    for (int cell = 0; cell < kAcross * kAcross * kAcross; ++cell) {
        const Vec3i at{cell / (kAcross * kAcross), cell / kAcross % kAcross, cell % kAcross};
        VoxelLeaf leaf;
        leaf.origin = (first + at) * kLeaf;
        leaf.first_voxel = static_cast<std::uint32_t>(out.coverage.size());
        leaf.first_lobe = static_cast<std::uint32_t>(out.lobes.size());
        counts.subvoxels += append_leaf(fit, leaf.origin - lo, leaf);
        if (out.coverage.size() > leaf.first_voxel) out.leaves.push_back(leaf);
    }
    counts.voxels = static_cast<std::int64_t>(out.coverage.size());
    counts.lobes = static_cast<std::int64_t>(out.lobes.size());
    counts.leaves = static_cast<std::int64_t>(out.leaves.size());
    return counts;
}

} // namespace heddle
