#pragma once

#include <heddle/base/platform.h>
#include <heddle/lod/merge_children.h>
#include <heddle/voxel/lattice_units.h>
#include <heddle/voxel/material_set.h>
#include <heddle/voxel/voxel_level.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace heddle {

/// Level whose voxels are as large as a block.
inline constexpr int kBlockLevel = 5;
static_assert(kBlockVoxels == 1 << kBlockLevel);

/// How the coverage of a parent follows from its children.
enum class CoverageRule : std::uint8_t {
    Union,   ///< exact: columns OR-ed along the axis, side by side across it
    Product, ///< no columns: transparencies multiply along the axis, average across it
    Mean     ///< the mean of the eight, as `naive` has it
};

/// What is the same for all voxels of a pyramid.
struct LevelOptions {
    MergeOptions merge;
    CoverageRule coverage = CoverageRule::Union;
    VoxelFields fields;    ///< of the levels above 0: no masks
    MaterialSet normals{}; ///< the materials whose lobes are of normals
    Lattice lattice;       ///< of level 0
    std::uint64_t seed = 0;
};

/// Mean of -ln(1 - c) over the axes: stands in for the directed area where a file has no sums.
/// @param subvoxels  per voxel axis: c is at most 1 - 1 / (2 columns)
[[nodiscard]] double mean_depth(const Coverage& c, int subvoxels);

/// What a voxel is before it is stored, beside its columns.
struct OpenVoxel {
    std::int64_t hits = 0; ///< subvoxels
    Vec3d seen;            ///< Product: 1 - coverage; Mean: coverage; else unused
    std::uint32_t first_lobe = 0;
    std::uint32_t order = 0; ///< VoxelBlock::merge_order
    std::uint8_t lobe_count = 0;
};

/// The voxels of one level in one block, unquantized, while the level above is built from them.
///
/// Columns along an axis are 4^level words of 8 x 8 bits (level 0's, or less with fewer subvoxels),
/// in Z-order: word (q, p) of the other two axes p < q, bits of q first. So a child's words are one
/// quarter of its parent's, and joining them is one loop of OR.
struct OpenLevel {
    static constexpr std::uint16_t kNone = 0xffff;

    int level = 0;
    Vec3i origin;                    ///< the block's corner in voxels of this level
    std::vector<std::uint16_t> slot; ///< by (x edge + y) edge + z: kNone or a voxel's number
    std::vector<OpenVoxel> voxels;
    std::vector<std::uint64_t> columns; ///< 3 x words() a voxel; Union only
    std::vector<DirectionSums> lobes;
    std::vector<MapSums> maps; ///< per lobe; with map sums only

    [[nodiscard]] int edge() const { return kBlockVoxels >> level; }
    [[nodiscard]] std::size_t words() const { return std::size_t{1} << (2 * level); }
    [[nodiscard]] std::size_t cell(Vec3i at) const {
        return static_cast<std::size_t>((at.x * edge() + at.y) * edge() + at.z);
    }
    /// Empties it for a block. @param block  its index
    void reset(int level_in, Vec3i block);
    /// Words along `axis` of a voxel.
    [[nodiscard]] std::span<std::uint64_t> words_of(std::size_t voxel, int axis) {
        return std::span(columns).subspan((3 * voxel + static_cast<std::size_t>(axis)) * words(),
                                          words());
    }
    /// Appends the words along all axes of a voxel.
    void append_words(std::size_t voxel, std::vector<std::uint64_t>& to) const {
        const auto first = columns.begin() + static_cast<std::ptrdiff_t>(3 * voxel * words());
        to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(3 * words()));
    }
    [[nodiscard]] std::span<const std::uint64_t> words_of(std::size_t voxel, int axis) const {
        return std::span(columns).subspan((3 * voxel + static_cast<std::size_t>(axis)) * words(),
                                          words());
    }
};

/// Which quarter of the parent's columns along `axis` child (x, y, z), each 0 or 1, fills.
[[nodiscard]] HEDDLE_HD constexpr int quarter(Vec3i child, int axis) {
    const int p = axis == 0 ? 1 : 0;
    const int q = axis == 2 ? 1 : 2;
    return 2 * child[q] + child[p];
}

/// part / whole for levels whose counts pass 64 bits in fraction16.
/// @param whole  an integer
[[nodiscard]] HEDDLE_HD inline std::uint16_t wide_fraction16(std::int64_t part, double whole) {
    if (whole < 0x1p46) return fraction16(part, static_cast<std::int64_t>(whole));
    const double share = static_cast<double>(part) / whole * 65535.0 + 0.5;
    return static_cast<std::uint16_t>(share < 65535.0 ? share : 65535.0);
}

/// Adds what child (x, y, z) shows to a parent that started as open_parent() gives it.
void join_seen(OpenVoxel& parent, CoverageRule rule, const std::array<const OpenVoxel*, 8>& child);

/// Takes level 0 of a block out of what is stored. Without sums, moments are those of the stored S.
/// @param block  its index
void open_block(const VoxelBlock& stored, Vec3i block, const LevelOptions& options, OpenLevel& out);

/// Builds a level from the one below it.
void build_level(const OpenLevel& below,
                 const LevelOptions& options,
                 LobePool& pool,
                 OpenLevel& out);

/// Appends the voxels of a level to a block, leaf by leaf: from level 3 on parts of leaves.
/// @param kept  gets their columns, 3 x words() a voxel; null: they are not kept
void store_level(const OpenLevel& level,
                 const LevelOptions& options,
                 LobePool& pool,
                 RecentFits& fits,
                 VoxelBlock& out,
                 std::vector<std::uint64_t>* kept = nullptr);

/// Appends a voxel's footprints.
void append_footprints(const OpenLevel& level,
                       std::size_t voxel,
                       const LevelOptions& options,
                       VoxelBlock& out);

[[nodiscard]] std::int64_t count_bits(std::span<const std::uint64_t> words);

/// Seed of a voxel's random numbers.
[[nodiscard]] std::uint64_t seed_of(const LevelOptions& options, int level, Vec3i index);

/// Appends what is stored of a voxel but its lobes and footprints.
/// @param covered  columns set along each axis; Union only
void append_coverage(const OpenVoxel& voxel,
                     const std::array<std::int64_t, 3>& covered,
                     int level,
                     const LevelOptions& options,
                     VoxelBlock& out);

} // namespace heddle
