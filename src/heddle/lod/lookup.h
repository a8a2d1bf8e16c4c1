#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>
#include <heddle/voxel/voxel_grid.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace heddle {

/// The two levels that a fractional one lies between, with their weights: these sum to 1.
struct LevelWeights {
    int floor = 0;
    int ceiling = 0; ///< floor where the level is whole
    float floor_weight = 1.0f;
    float ceiling_weight = 0.0f;
};

/// Level whose voxels are as wide as a footprint.
///
/// level = log2(width / voxel size)                                        [Fabre26, eq. 19]
///
/// The paper's MaxLevels - 1 + log2(width) has the width in units of the whole volume.
/// @param width       of the footprint, scene units; 0 and less give -infinity or NaN
/// @param voxel_size  edge of the finest voxels, scene units, > 0; of unequal ones the longest, so
///                    that no voxel is wider than the footprint
[[nodiscard]] HEDDLE_HD inline float level_of_footprint(float width, float voxel_size) {
    return std::log2(width / voxel_size);
}

/// Weights of the two levels beside a fractional one, continuous in it.
///
/// Of the ceiling level - floor, of the floor the rest. As printed in [Fabre26, eq. 20-21] both are
/// negative.
/// @param level        clamped to [0, level_count - 1]; NaN gives 0
/// @param level_count  >= 1
[[nodiscard]] HEDDLE_HD inline LevelWeights weights_of_level(float level, int level_count) {
    const auto last = static_cast<float>(level_count - 1);
    const float inside = level > 0.0f ? (level < last ? level : last) : 0.0f;
    LevelWeights out;
    out.floor = static_cast<int>(inside);
    out.ceiling_weight = inside - static_cast<float>(out.floor);
    out.floor_weight = 1.0f - out.ceiling_weight;
    out.ceiling = out.ceiling_weight > 0.0f ? out.floor + 1 : out.floor;
    return out;
}

/// The voxels of 8 x 8 x 8 as a lookup holds them.
struct LookupLeaf {
    std::uint64_t first_voxel = 0;
    std::uint64_t first_lobe = 0;
    std::array<std::uint64_t, 8> active{}; ///< as VoxelLeaf::active
    std::array<std::uint16_t, 8> before{}; ///< voxels of the leaf before word x
    Vec3i origin;
};
static_assert(sizeof(LookupLeaf) == 112);

/// What a level holds of one voxel. Spans hold as long as the lookup does.
struct VoxelView {
    const Coverage* coverage = nullptr;
    std::span<const Lobe> lobes;          ///< 1 to K
    std::span<const LobeMaps> maps;       ///< as many, or none
    std::span<const PackedSggx> tangents; ///< as many, or none
    std::uint32_t merge_order = 0;        ///< VoxelBlock::merge_order
    /// VoxelBlock::footprints; may be null
    const std::array<std::uint64_t, 3>* footprints = nullptr;
    const std::array<std::uint8_t, 3>* correlation = nullptr; ///< may be null
};

/// One level's voxels by index: arrays that lie in one piece each, for a host or a device.
///
/// A hash table names the leaf, its masks count the voxels before: one probe or two on average (the
/// table is at most half full), and no search inside the leaf.
struct LevelView {
    static constexpr std::uint32_t kNone = 0xffffffff;

    std::span<const std::uint32_t> slots; ///< a power of two: numbers of leaves, or kNone
    std::span<const LookupLeaf> leaves;
    std::span<const Coverage> coverage;         ///< per voxel
    std::span<const std::uint16_t> lobe_place;  ///< per voxel: first lobe in the leaf's, 12 bits,
                                                ///< and lobes - 1 above them
    std::span<const Lobe> lobes;                ///< per lobe
    std::span<const LobeMaps> maps;             ///< per lobe, or none
    std::span<const PackedSggx> tangents;       ///< per lobe, or none
    std::span<const std::uint32_t> merge_order; ///< per voxel, or none
    std::span<const std::array<std::uint64_t, 3>> footprints; ///< per voxel, or none
    std::span<const std::array<std::uint8_t, 3>> correlation; ///< per voxel, or none

    /// Where in `slots` the search for a leaf starts.
    [[nodiscard]] HEDDLE_HD static std::uint32_t hash(Vec3i leaf);
    /// The voxel of an index of this level; nothing where none is.
    [[nodiscard]] HEDDLE_HD std::optional<VoxelView> find(Vec3i index) const;

private:
    [[nodiscard]] HEDDLE_HD const LookupLeaf* find_leaf(Vec3i origin) const;
    [[nodiscard]] HEDDLE_HD VoxelView view(const LookupLeaf& leaf, std::uint64_t voxel) const;
};

/// The voxels of both levels beside a fractional one at one place.
struct LevelSample {
    LevelWeights weights;
    std::optional<VoxelView> floor;
    std::optional<VoxelView> ceiling; ///< the floor's where the level is whole
};

/// All levels of an object by place: what a renderer walks through.
///
/// A lookup reads about six cache lines: slot, leaf (two), place of lobes, coverage, lobe. In random
/// order over 8.1 M voxels that is .15 us at level 3 and .6 us at level 0, on a busy machine. Memory:
/// what blocks take for the same (columns and sums left out), 2 bytes a voxel, 112 bytes and 8 to 16
/// of slots a leaf: 176 MiB there, where blocks take 153. Never changes: any number of threads.
class LevelLookup {
public:
    /// Copies the levels; they may be dropped then.
    /// @param levels  at least one, finest first
    explicit LevelLookup(const VoxelLevels& levels);

    [[nodiscard]] int level_count() const { return static_cast<int>(levels_.size()); }
    [[nodiscard]] const VoxelGridInfo& info(int level) const { return at(level).info; }
    [[nodiscard]] LevelView view(int level) const;

    /// The voxel of a level that a place lies in; nothing where none is. A place on a face belongs
    /// to the voxel of the higher index.
    /// @param level     from 0 to level_count() - 1
    /// @param position  scene units; not finite gives nothing
    [[nodiscard]] std::optional<VoxelView> find(int level, Vec3d position) const;

    /// Both voxels at a place for a fractional level.
    /// @param level  as of weights_of_level
    [[nodiscard]] LevelSample sample(Vec3d position, float level) const;

    [[nodiscard]] std::int64_t byte_count() const;

private:
    struct Level {
        VoxelGridInfo info;
        std::vector<LookupLeaf> leaves;
        std::vector<std::uint32_t> slots;
        std::vector<std::uint16_t> lobe_place;
        VoxelBlock arrays; ///< per voxel and per lobe, one block after the other; without leaves,
                           ///< counts of lobes, columns and sums
    };
    [[nodiscard]] const Level& at(int level) const {
        return levels_[static_cast<std::size_t>(level)];
    }
    static void append(const VoxelBlock& block, Level& level);
    static void fill_slots(Level& level);
    [[nodiscard]] std::optional<VoxelView> find_index(int level, Vec3i finest) const;

    std::vector<Level> levels_;
};

HEDDLE_HD inline std::uint32_t LevelView::hash(Vec3i leaf) {
    // three odd factors [Teschner 2003], then the high bits into the low ones
    const auto word = [](std::int32_t v) { return static_cast<std::uint32_t>(v >> 3); };
    std::uint32_t h =
        word(leaf.x) * 73856093u ^ word(leaf.y) * 19349663u ^ word(leaf.z) * 83492791u;
    h ^= h >> 15;
    h *= 0x2c1b3c6du;
    return h ^ h >> 13;
}

HEDDLE_HD inline const LookupLeaf* LevelView::find_leaf(Vec3i origin) const {
    const auto mask = static_cast<std::uint32_t>(slots.size() - 1);
    for (std::uint32_t i = hash(origin) & mask; slots[i] != kNone; i = (i + 1) & mask) {
        if (leaves[slots[i]].origin == origin) return &leaves[slots[i]];
    }
    return nullptr;
}

HEDDLE_HD inline VoxelView LevelView::view(const LookupLeaf& leaf, std::uint64_t voxel) const {
    const std::uint64_t v = leaf.first_voxel + voxel;
    const std::uint64_t first = leaf.first_lobe + (lobe_place[v] & 0xfffu);
    const std::uint64_t count = (lobe_place[v] >> 12) + 1u;
    VoxelView out;
    out.coverage = &coverage[v];
    out.lobes = lobes.subspan(first, count);
    if (!maps.empty()) out.maps = maps.subspan(first, count);
    if (!tangents.empty()) out.tangents = tangents.subspan(first, count);
    if (!merge_order.empty()) out.merge_order = merge_order[v];
    if (!footprints.empty()) out.footprints = &footprints[v];
    if (!correlation.empty()) out.correlation = &correlation[v];
    return out;
}

HEDDLE_HD inline std::optional<VoxelView> LevelView::find(Vec3i index) const {
    const LookupLeaf* leaf = find_leaf({index.x & ~7, index.y & ~7, index.z & ~7});
    if (leaf == nullptr) return std::nullopt;
    const auto x = static_cast<std::size_t>(index.x & 7);
    const std::uint64_t bit = std::uint64_t{1} << ((index.y & 7) * 8 + (index.z & 7));
    if ((leaf->active[x] & bit) == 0) return std::nullopt;
    const int inside = std::popcount(leaf->active[x] & (bit - 1));
    return view(*leaf, leaf->before[x] + static_cast<std::uint64_t>(inside));
}

} // namespace heddle
