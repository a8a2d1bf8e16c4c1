#include <heddle/voxel/fit_block.h>

#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>

#include <algorithm>
#include <array>
#include <bit>

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

int hit_subvoxels(const VoxelSums& voxel) {
    int hits = 0;
    for (const std::uint64_t word : voxel.sub) hits += std::popcount(word);
    return hits;
}

Coverage coverage_of(const VoxelSums& voxel, const FitOptions& options, int hits) {
    const int n = options.subvoxels;
    const std::array<std::uint64_t, 3> column =
        options.project_subvoxels ? project(voxel, n) : voxel.column;
    return {fraction16(std::popcount(column[0]), n * n), fraction16(std::popcount(column[1]), n * n),
            fraction16(std::popcount(column[2]), n * n), fraction16(hits, n * n * n)};
}

SymmetricMatrix to_moment(const std::array<std::int64_t, 6>& sums, std::int64_t weight) {
    const double inv = 1.0 / static_cast<double>(weight);
    const auto entry = [&](std::size_t i) {
        return static_cast<float>(static_cast<double>(sums[i]) * inv);
    };
    return {entry(0), entry(1), entry(2), entry(3), entry(4), entry(5)};
}

std::uint8_t mean8(std::int64_t sum, std::int64_t weight) {
    return static_cast<std::uint8_t>(std::clamp<std::int64_t>((sum + weight / 2) / weight, 0, 255));
}

void append_lobe(const BlockSums& sums,
                 const VoxelSums& voxel,
                 const LobeSums& lobe,
                 std::int64_t total,
                 const FitOptions& options,
                 VoxelBlock& out) {
    const auto share = static_cast<double>(lobe.weight) / static_cast<double>(total);
    out.lobes.push_back({pack(fit_sggx(to_moment(lobe.moment, lobe.weight))),
                         static_cast<std::uint8_t>(std::max(1, static_cast<int>(share * 255.0 + 0.5))),
                         static_cast<std::uint8_t>(lobe.material)});
    const MapSums* maps = sums.find_maps(voxel, lobe);
    if (options.fields.albedo || options.fields.surface) {
        LobeMaps mean;
        if (maps != nullptr) {
            for (std::size_t i = 0; i < 3; ++i) mean.albedo[i] = mean8(maps->albedo[i], lobe.weight);
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

std::int64_t append_voxel(const BlockSums& sums,
                          const VoxelSums& voxel,
                          const FitOptions& options,
                          VoxelBlock& out,
                          std::vector<const LobeSums*>& order) {
    const int hits = hit_subvoxels(voxel);
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
    for (const LobeSums* l : order) append_lobe(sums, voxel, *l, total, options, out);
    out.lobe_count.push_back(static_cast<std::uint8_t>(order.size()));
    return hits;
}

} // namespace

BlockCounts fit_block(const BlockSums& sums, const FitOptions& options, VoxelBlock& out) {
    BlockCounts counts;
    std::vector<const LobeSums*> order;
    const Vec3i lo = sums.lo();
    const Vec3i size = sums.hi() - lo;
    const auto leaf_of = [](int v) { return v >= 0 ? v / kLeaf : -((-v + kLeaf - 1) / kLeaf); };
    for (int cell = 0; cell < (kLeaves + 1) * (kLeaves + 1) * (kLeaves + 1); ++cell) {
        const Vec3i at{cell / ((kLeaves + 1) * (kLeaves + 1)), cell / (kLeaves + 1) % (kLeaves + 1),
                       cell % (kLeaves + 1)};
        VoxelLeaf leaf;
        leaf.origin = Vec3i{leaf_of(lo.x), leaf_of(lo.y), leaf_of(lo.z)} + at;
        leaf.origin = leaf.origin * kLeaf;
        leaf.first_voxel = static_cast<std::uint32_t>(out.coverage.size());
        leaf.first_lobe = static_cast<std::uint32_t>(out.lobes.size());
        const Vec3i base = leaf.origin - lo; // a region's block may start inside a leaf
        for (int i = 0; i < kLeaf * kLeaf * kLeaf; ++i) {
            const Vec3i v = base + Vec3i{i >> 6, i >> 3 & 7, i & 7};
            if (v.x < 0 || v.y < 0 || v.z < 0 || v.x >= size.x || v.y >= size.y || v.z >= size.z) {
                continue;
            }
            const VoxelSums* voxel = sums.find(v.x, v.y, v.z);
            if (voxel == nullptr) continue;
            leaf.active[static_cast<std::size_t>(i >> 6)] |= std::uint64_t{1} << (i & 63);
            counts.subvoxels += append_voxel(sums, *voxel, options, out, order);
        }
        if (out.coverage.size() > leaf.first_voxel) out.leaves.push_back(leaf);
    }
    counts.voxels = static_cast<std::int64_t>(out.coverage.size());
    counts.lobes = static_cast<std::int64_t>(out.lobes.size());
    counts.leaves = static_cast<std::int64_t>(out.leaves.size());
    return counts;
}

} // namespace heddle
