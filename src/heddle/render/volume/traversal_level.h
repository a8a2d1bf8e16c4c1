#pragma once

#include <heddle/base/vec.h>
#include <heddle/leaf_table/leaf_table.h>
#include <heddle/leaf_table/ranked_mask.h>
#include <heddle/voxel/index_box.h>
#include <heddle/voxel/voxel_level.h>

#include <array>
#include <cstdint>
#include <vector>

namespace heddle {

/// One unit of TraversalVoxel::depth in optical depth: coverage is at most 1 - 1 / 2^21 at level 8,
/// so depths end below 16.
inline constexpr float kDepthUnit = 16.0f / 65535.0f;

/// What a ray needs of a voxel that it only passes: one 8-byte read.
struct TraversalVoxel {
    std::array<std::uint16_t, 3> depth{}; ///< -ln(1 - coverage) along each axis, in kDepthUnit
    std::uint16_t lobe_offset = 0; ///< its first lobe in the leaf's, 12 bits, and lobes - 1 above
};
static_assert(sizeof(TraversalVoxel) == 8);

/// 8 x 8 x 8 voxels.
struct TraversalLeaf {
    RankedMask mask;
    std::uint64_t first_voxel = 0;
    std::uint64_t first_lobe = 0;

    /// Number of a voxel in the level's arrays; -1 where none is.
    /// @param at  any index: its lowest three bits count
    [[nodiscard]] std::int64_t find(Vec3i at) const {
        const std::int32_t number = mask.find(at);
        return number < 0 ? -1 : static_cast<std::int64_t>(first_voxel) + number;
    }
};

/// One level of an object as rays walk it: leaves of 8^3 voxels in a LeafTable, so that emptiness
/// is skipped 64 or 8 voxels at a time.
///
/// Memory: 8 bytes a voxel, 8 a lobe, 96 a leaf, those of the table, and the optional arrays.
class TraversalLevel {
public:
    /// Copies what `source` holds; it may be dropped then.
    explicit TraversalLevel(const VoxelLevel& source);

    [[nodiscard]] const VoxelLevelInfo& info() const { return info_; }
    /// Voxel indices that hold all voxels: [lo, hi).
    [[nodiscard]] Vec3i lo() const { return lo_; }
    [[nodiscard]] Vec3i hi() const { return hi_; }

    /// What is at a voxel index: a leaf, or how much around it is empty.
    struct LeafLookup {
        const TraversalLeaf* leaf = nullptr;
        std::int32_t size = 64; ///< without leaf: edge of the aligned cube that is empty
    };
    [[nodiscard]] LeafLookup find_leaf(Vec3i at) const {
        const LeafTable<3>::LeafLookup place = table_.find(at);
        return {place.leaf == LeafTable<3>::kNone ? nullptr : &leaves_[place.leaf], place.size};
    }

    [[nodiscard]] const TraversalVoxel& voxel(std::int64_t v) const {
        return voxels_[static_cast<std::size_t>(v)];
    }
    /// First lobe and number of lobes of voxel `v` of `leaf`.
    struct LobeRange {
        std::size_t first, count;
    };
    [[nodiscard]] LobeRange lobes_of(const TraversalLeaf& leaf, std::int64_t v) const {
        const std::uint16_t place = voxel(v).lobe_offset;
        return {leaf.first_lobe + (place & 0xfffu), (place >> 12) + std::size_t{1}};
    }
    [[nodiscard]] const Lobe& lobe(std::size_t l) const { return lobes_[l]; }
    /// Null where the grid has none.
    [[nodiscard]] const LobeMaps* maps(std::size_t l) const {
        return maps_.empty() ? nullptr : &maps_[l];
    }
    [[nodiscard]] const PackedSggx* tangent(std::size_t l) const {
        return tangents_.empty() ? nullptr : &tangents_[l];
    }
    /// No material is of surfaces.
    [[nodiscard]] bool fibers_only() const { return fibers_only_; }
    /// log2 of the voxel's longest edge over the thinnest fiber's radius; 0 where no radius is
    /// known.
    [[nodiscard]] float fibers_across() const { return fibers_across_; }
    [[nodiscard]] bool has_footprints() const { return !footprints_.empty(); }
    /// Footprints of 4 x 4 cells along x, y, z, 16 bits each from the lowest on: bit 4 b + a, a and
    /// b the cell's place on the next two axes.
    /// @param v  of a level that has footprints
    [[nodiscard]] std::uint64_t footprints(std::int64_t v) const {
        return footprints_[static_cast<std::size_t>(v)];
    }
    [[nodiscard]] bool has_correlation() const { return !correlation_.empty(); }
    /// VoxelBlock::correlation. @param v  of a level that has it
    [[nodiscard]] const std::array<std::uint8_t, 3>& correlation(std::int64_t v) const {
        return correlation_[static_cast<std::size_t>(v)];
    }
    [[nodiscard]] std::int64_t byte_count() const;

private:
    void append(const VoxelBlock& block,
                const std::vector<std::uint16_t>& depth_of_coverage,
                IndexBox& box);

    VoxelLevelInfo info_;
    bool fibers_only_ = true;
    float fibers_across_ = 0.0f;
    Vec3i lo_{}, hi_{};
    LeafTable<3> table_;
    std::vector<TraversalLeaf> leaves_; ///< by the table's numbers
    std::vector<TraversalVoxel> voxels_;
    std::vector<Lobe> lobes_;
    std::vector<LobeMaps> maps_;
    std::vector<PackedSggx> tangents_;
    std::vector<std::uint64_t> footprints_;
    std::vector<std::array<std::uint8_t, 3>> correlation_;
};

} // namespace heddle
