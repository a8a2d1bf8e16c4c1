#include <heddle/voxelize/block/fit_block.h>

#include <heddle/base/trig.h>
#include <heddle/voxel/footprint.h>
#include <heddle/voxel/lobe_pool.h>
#include <heddle/voxel/occupancy.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace heddle {
namespace {

constexpr int kLeaf = 8;
constexpr int kLeaves = kBlockVoxels / kLeaf;

/// Returns the columns along each axis that contain an occupied subvoxel.  [Fabre26, 3.5]
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

/// The data that a block's voxels share while they are fitted.
struct BlockFit {
    const BlockSums& sums;
    const FitOptions& options;
    VoxelBlock& out;
    std::vector<const LobeSums*> list{};
    LobePool pool{};
    RecentFits fits{};
};

/// Moves the voxel's lobes to the pool, one per material, and merges them to the allowed number.
/// @return  VoxelBlock::merge_order
HEDDLE_INLINE std::uint32_t pool_lobes(BlockFit& fit, const VoxelSums& voxel) {
    const BlockSums& sums = fit.sums;
    const FitOptions& options = fit.options;
    LobePool& pool = fit.pool;
    pool.count = 0;
    const bool with_maps = options.fields.map_sums();
    std::vector<const LobeSums*>& list = fit.list;
    list.clear();
    for (const LobeSums* l = &voxel.lobe; l != nullptr; l = sums.next(*l)) list.push_back(l);
    if (list.size() > 1) { // they are in the order of gathering, which depends on the region
        std::sort(list.begin(), list.end(),
                  [](const LobeSums* a, const LobeSums* b) { return a->material < b->material; });
    }
    for (const LobeSums* l : list) {
        if (pool.count == kMaxPool) reduce_by_moments(pool, kMaxLobes, with_maps);
        DirectionSums lobe{.weight = l->weight,
                           .material = l->material,
                           .normals = options.normals.has(l->material)};
        std::copy_n(l->moment.begin(), 6, lobe.moment);
        pool.add(lobe, sums.find_maps(voxel, *l));
    }
    return reduce_by_moments(pool, options.max_lobes, with_maps);
}

/// Appends the columns and sums that coarser levels are built from.
HEDDLE_INLINE void append_sums(BlockFit& fit, const std::array<std::uint64_t, 3>& column) {
    const LobePool& pool = fit.pool;
    fit.out.columns.push_back(column);
    for (std::size_t i = 0; i < static_cast<std::size_t>(pool.count); ++i) {
        LobeMoment& sums = fit.out.moments.emplace_back();
        std::copy_n(pool.sums[i].moment, 6, sums.moment.begin());
        sums.weight = pool.sums[i].weight;
        if (fit.options.fields.map_sums()) fit.out.map_sums.push_back(pool.maps[i]);
    }
}

HEDDLE_INLINE std::int64_t append_voxel(BlockFit& fit, const VoxelSums& voxel) {
    const FitOptions& options = fit.options;
    const int n = options.subvoxels;
    const int hits = hit_subvoxels(voxel, n);
    const std::array<std::uint64_t, 3> column =
        options.project_subvoxels ? project(voxel, n) : voxel.column;
    fit.out.coverage.push_back(
        {fraction16(std::popcount(column[0]), n * n), fraction16(std::popcount(column[1]), n * n),
         fraction16(std::popcount(column[2]), n * n), fraction16(hits, n * n * n)});
    if (options.fields.footprints != 0) {
        std::array<std::uint64_t, 3>& bits = fit.out.footprints.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Footprint face(0, n);
            face.add(0, column[axis]);
            bits[axis] = face.bits(options.fields.footprints);
        }
    }
    if (options.fields.occupancy) {
        fit.out.occupancy.push_back(cells_of_voxel(voxel.sub.data(), column.data(), n));
    }
    const std::uint32_t order = pool_lobes(fit, voxel);
    append_lobes(fit.pool, order, options.fields, fit.fits, fit.out);
    if (options.fields.masks) append_sums(fit, column);
    return hits;
}

/// Returns true if a row of a leaf, entirely inside the block, has no voxel, as most of a surface.
HEDDLE_INLINE bool is_empty_row(const std::uint16_t* slots) {
    static_assert(BlockSums::kNone == 0xffff);
    std::uint64_t words[2];
    std::memcpy(words, slots, sizeof words);
    return (words[0] & words[1]) == ~std::uint64_t{0};
}

/// Appends a leaf's voxels.
/// @param base  corner of the leaf relative to the block's lo; negative if a region clips the leaf
/// @return      number of occupied subvoxels
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
