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

/// The level whose voxels are as large as a block.
inline constexpr int kBlockLevel = 5;
static_assert(kBlockVoxels == 1 << kBlockLevel);

/// How the coverage of a parent follows from its children.
enum class CoverageRule : std::uint8_t {
    Union,   ///< exact: columns are OR-ed along the axis and placed side by side across it
    Product, ///< without columns: transparencies are multiplied along the axis, averaged across it
    Mean     ///< the mean of the eight children, for the method `naive`
};

/// What all levels of an object share while they are built.
struct LevelOptions {
    MergeOptions merge;
    CoverageRule coverage = CoverageRule::Union;
    VoxelFields fields;    ///< fields of the levels above 0, without masks
    MaterialSet normals{}; ///< the materials whose lobes describe normals
    Lattice lattice;       ///< lattice of level 0
    std::uint64_t seed = 0;
};

/// Returns the mean of -ln(1 - c) over the axes, which replaces the directed area if a file has no
/// sums.
/// @param subvoxels  subvoxels per voxel axis; c is clamped to 1 - 1 / (2 columns)
[[nodiscard]] double mean_depth(const Coverage& c, int subvoxels);

/// The slab of a voxel whose first lobe is of a surface, as it is stored, and what a parent needs
/// to hold it.
struct OpenSlab {
    bool there = false; ///< else the first lobe is of fibers, which have no planes
    PlaneSlab planes;
    Vec3d gradient; ///< slab_gradient()

    OpenSlab() = default;
    /// @param edges  of the voxel, of which only the ratios count
    HEDDLE_HD OpenSlab(PlaneSlab stored, Vec3d edges)
        : there(true), planes(stored), gradient(slab_gradient(slab_normal(stored), edges)) {}
};

/// A voxel before it is stored, without its columns.
struct OpenVoxel {
    std::int64_t hits = 0; ///< number of occupied subvoxels
    Vec3d seen;            ///< Product: 1 - coverage; Mean: coverage; else unused
    std::uint32_t first_lobe = 0;
    std::uint32_t order = 0; ///< VoxelBlock::merge_order
    std::uint8_t lobe_count = 0;
    std::uint64_t cells = 0; ///< VoxelBlock::occupancy
    OpenSlab slab;           ///< with fields.slabs
};

/// The voxels of one level in one block, unquantized, while the level above is built from them.
///
/// Columns along an axis are 4^level words in Z-order: word (q, p) of the other two axes p < q,
/// bits of q first. A word has the 8 x 8 bits of a voxel of level 0 (fewer bits if it has fewer
/// subvoxels). So a child's words are one quarter of its parent's and are joined by one loop of
/// ORs.
struct OpenLevel {
    static constexpr std::uint16_t kNone = 0xffff;

    int level = 0;
    Vec3i origin;                    ///< the block's corner in voxels of this level
    std::vector<std::uint16_t> slot; ///< [(x edge + y) edge + z]: kNone or a voxel's number
    std::vector<OpenVoxel> voxels;
    std::vector<std::uint64_t> columns; ///< 3 x words() per voxel; Union only
    std::vector<DirectionSums> lobes;
    std::vector<MapSums> maps; ///< per lobe; with map sums only

    [[nodiscard]] int edge() const { return kBlockVoxels >> level; }
    [[nodiscard]] std::size_t words() const { return std::size_t{1} << (2 * level); }
    [[nodiscard]] std::size_t cell(Vec3i at) const {
        return static_cast<std::size_t>((at.x * edge() + at.y) * edge() + at.z);
    }
    /// Removes all voxels and prepares it for a block. @param block  its index
    void reset(int level_in, Vec3i block);
    /// Returns the words along `axis` of a voxel.
    [[nodiscard]] std::span<std::uint64_t> words_of(std::size_t voxel, int axis) {
        return std::span(columns).subspan((3 * voxel + static_cast<std::size_t>(axis)) * words(),
                                          words());
    }
    /// Appends the words of a voxel along all axes to `to`.
    void append_words(std::size_t voxel, std::vector<std::uint64_t>& to) const {
        const auto first = columns.begin() + static_cast<std::ptrdiff_t>(3 * voxel * words());
        to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(3 * words()));
    }
    [[nodiscard]] std::span<const std::uint64_t> words_of(std::size_t voxel, int axis) const {
        return std::span(columns).subspan((3 * voxel + static_cast<std::size_t>(axis)) * words(),
                                          words());
    }
};

/// Returns which quarter of the parent's columns along `axis` belongs to child (x, y, z), each 0 or
/// 1.
[[nodiscard]] HEDDLE_HD constexpr int quarter(Vec3i child, int axis) {
    const int p = axis == 0 ? 1 : 0;
    const int q = axis == 2 ? 1 : 2;
    return 2 * child[q] + child[p];
}

/// Returns fraction16(part, whole) for counts with which fraction16() would overflow.
/// @param whole  an integer
[[nodiscard]] HEDDLE_HD inline std::uint16_t wide_fraction16(std::int64_t part, double whole) {
    if (whole < 0x1p46) return fraction16(part, static_cast<std::int64_t>(whole));
    const double share = static_cast<double>(part) / whole * 65535.0 + 0.5;
    return static_cast<std::uint16_t>(share < 65535.0 ? share : 65535.0);
}

/// Adds the hits and cells of all children to a parent, and their `seen` by the coverage rule.
/// @param child  number 4 x + 2 y + z; null: no such child
void join_seen(OpenVoxel& parent, CoverageRule rule, const std::array<const OpenVoxel*, 8>& child);

/// Makes the slab of a parent hold those of its children.
/// @param first_lobe  of the parent, before it is stored
/// @param child       number 4 x + 2 y + z; null: no such child
void join_slabs(OpenVoxel& parent,
                const DirectionSums& first_lobe,
                const LevelOptions& options,
                const std::array<const OpenVoxel*, 8>& child);

/// Makes level 0 of a block from the stored block. If it has no sums, moments are those of the
/// stored S.
/// @param block  index of the block
void open_block(const VoxelBlock& stored, Vec3i block, const LevelOptions& options, OpenLevel& out);

/// Builds a level from the level below it.
void build_level(const OpenLevel& below,
                 const LevelOptions& options,
                 LobePool& pool,
                 OpenLevel& out);

/// Appends the voxels of a level to a block, leaf by leaf. From level 3 on these are parts of
/// leaves.
/// @param kept  their columns are appended to it, 3 x words() per voxel; may be null
void store_level(const OpenLevel& level,
                 const LevelOptions& options,
                 LobePool& pool,
                 RecentFits& fits,
                 VoxelBlock& out,
                 std::vector<std::uint64_t>* kept = nullptr);

/// Appends a voxel's footprints to a block.
void append_footprints(const OpenLevel& level,
                       std::size_t voxel,
                       const LevelOptions& options,
                       VoxelBlock& out);

[[nodiscard]] std::int64_t count_bits(std::span<const std::uint64_t> words);

/// Returns the seed of a voxel's random numbers.
[[nodiscard]] std::uint64_t seed_of(const LevelOptions& options, int level, Vec3i index);

/// Appends all stored data of a voxel except its lobes and footprints.
/// @param covered  number of covered columns along each axis; Union only
void append_coverage(const OpenVoxel& voxel,
                     const std::array<std::int64_t, 3>& covered,
                     int level,
                     const LevelOptions& options,
                     VoxelBlock& out);

} // namespace heddle
