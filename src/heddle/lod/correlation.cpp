#include <heddle/lod/correlation.h>

#include <heddle/base/parallel.h>
#include <heddle/leaf_table/index_table.h>
#include <heddle/voxel/leaf_voxels.h>

#include <algorithm>
#include <bit>
#include <tuple>

namespace heddle {
namespace {

IndexTable number(std::span<const Vec3i> index) {
    IndexTable out;
    for (const Vec3i at : index) out.add(at);
    return out;
}

constexpr std::size_t kNone = ~std::size_t{0};

/// Returns the number in its block of the voxel with index `at`; kNone if there is none.
std::size_t find_voxel(const VoxelBlock& block, Vec3i at) {
    const Vec3i origin{at.x & ~7, at.y & ~7, at.z & ~7};
    const auto key = [](Vec3i o) { return std::tuple(o.x, o.y, o.z); };
    const auto leaf =
        std::lower_bound(block.leaves.begin(), block.leaves.end(), origin,
                         [&](const VoxelLeaf& l, Vec3i o) { return key(l.origin) < key(o); });
    if (leaf == block.leaves.end() || !(leaf->origin == origin)) return kNone;
    const auto word = static_cast<std::size_t>(at.x - origin.x);
    const int bit = (at.y - origin.y) * 8 + (at.z - origin.z);
    if ((leaf->active[word] >> bit & 1) == 0) return kNone;
    std::size_t before = leaf->first_voxel;
    for (std::size_t x = 0; x < word; ++x) {
        before += static_cast<std::size_t>(std::popcount(leaf->active[x]));
    }
    const std::uint64_t below = leaf->active[word] & ((std::uint64_t{1} << bit) - 1);
    return before + static_cast<std::size_t>(std::popcount(below));
}

struct Counts {
    std::int64_t first = 0, second = 0, both = 0;

    void add(std::uint64_t a, std::uint64_t b) {
        first += std::popcount(a);
        second += std::popcount(b);
        both += std::popcount(a | b);
    }
};

Counts count(const UpperVoxel::Runs& a, const UpperVoxel::Runs& b) {
    static const UpperVoxel::Run::element_type kEmpty{};
    Counts sum;
    auto i = a.begin();
    auto j = b.begin();
    while (i != a.end() || j != b.end()) {
        const bool in_a = i != a.end() && (j == b.end() || i->first <= j->first);
        const bool in_b = j != b.end() && (i == a.end() || j->first <= i->first);
        const auto& p = in_a ? *i->second : kEmpty;
        const auto& q = in_b ? *j->second : kEmpty;
        for (std::size_t k = 0; k < p.size(); ++k) sum.add(p[k], q[k]);
        if (in_a) ++i;
        if (in_b) ++j;
    }
    return sum;
}

Vec3i next_along(Vec3i at, int axis) {
    at[axis] += 1;
    return at;
}

} // namespace

std::uint8_t
correlation_of(std::int64_t first, std::int64_t second, std::int64_t both, double columns) {
    const double c1 = static_cast<double>(first) / columns;
    const double c2 = static_cast<double>(second) / columns;
    const double u = static_cast<double>(both) / columns;
    const double independent = c1 + c2 - c1 * c2;
    const double room = independent - std::max(c1, c2);
    if (!(room > 0.0)) return 255;
    return static_cast<std::uint8_t>(std::clamp((independent - u) / room, 0.0, 1.0) * 255.0 + 0.5);
}

void fill_correlation(std::span<const Vec3i> index,
                      std::span<VoxelBlock> blocks,
                      std::span<const KeptColumns> kept,
                      int level,
                      double columns) {
    const IndexTable numbers = number(index);
    const std::size_t words = std::size_t{1} << (2 * level);
    const int shift = kBlockLevel - level;
    parallel_chunks(blocks.size(), 1, [&](std::size_t b, std::size_t) {
        VoxelBlock& block = blocks[b];
        block.correlation.reserve(block.coverage.size());
        const auto face_of = [&](std::size_t of, std::size_t voxel, int axis) {
            return kept[of].data() + (3 * voxel + static_cast<std::size_t>(axis)) * words;
        };
        for_each_voxel(block, [&](const BlockVoxel& v) {
            std::array<std::uint8_t, 3>& rho = block.correlation.emplace_back();
            for (int axis = 0; axis < 3; ++axis) {
                const Vec3i next = next_along(v.at, axis);
                const std::uint32_t there =
                    numbers.find({next.x >> shift, next.y >> shift, next.z >> shift});
                if (there == IndexTable::kNone) continue;
                const std::size_t voxel = find_voxel(blocks[there], next);
                if (voxel == kNone) continue;
                Counts sum;
                const std::uint64_t* p = face_of(b, v.voxel, axis);
                const std::uint64_t* q = face_of(there, voxel, axis);
                for (std::size_t k = 0; k < words; ++k) sum.add(p[k], q[k]);
                rho[static_cast<std::size_t>(axis)] =
                    correlation_of(sum.first, sum.second, sum.both, columns);
            }
        });
    });
}

void fill_upper_correlation(std::span<const Vec3i> index,
                            std::span<VoxelBlock> blocks,
                            std::span<const std::array<UpperVoxel::Runs, 3>> kept,
                            double columns) {
    const IndexTable numbers = number(index);
    parallel_chunks(blocks.size(), 1, [&](std::size_t b, std::size_t) {
        if (blocks[b].coverage.empty()) return;
        std::array<std::uint8_t, 3>& rho = blocks[b].correlation.emplace_back();
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const std::uint32_t there = numbers.find(next_along(index[b], axis));
            if (there == IndexTable::kNone || blocks[there].coverage.empty()) continue;
            const Counts sum = count(kept[b][a], kept[there][a]);
            rho[a] = correlation_of(sum.first, sum.second, sum.both, columns);
        }
    });
}

} // namespace heddle
