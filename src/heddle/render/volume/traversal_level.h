#pragma once

#include <heddle/base/vec.h>
#include <heddle/leaf_table/leaf_table.h>
#include <heddle/leaf_table/ranked_mask.h>
#include <heddle/render/volume/cell_extinction.h>
#include <heddle/render/volume/sheet_voxel.h>
#include <heddle/voxel/index_box.h>
#include <heddle/voxel/voxel_level.h>

#include <array>
#include <cstdint>
#include <vector>

namespace heddle {

/// Optical depth of one unit of TraversalVoxel::depth. Coverage is at most 1 - 1 / 2^21 at level 8,
/// so optical depths are below 16.
inline constexpr float kDepthUnit = 16.0f / 65535.0f;

/// The data that a ray needs to pass a voxel: one read of 8 bytes.
struct TraversalVoxel {
    std::array<std::uint16_t, 3> depth{}; ///< -ln(1 - coverage) along each axis, in kDepthUnit; of
                                          ///< a level with cells: CellExtinction::bits
    std::uint16_t lobe_offset =
        0; ///< 12 low bits: first lobe within the leaf; 4 high bits: lobes - 1
};
static_assert(sizeof(TraversalVoxel) == 8);

/// 8 x 8 x 8 voxels.
struct TraversalLeaf {
    RankedMask mask;
    std::uint64_t first_voxel = 0;
    std::uint64_t first_lobe = 0;

    /// Returns the number of a voxel in the level's arrays; -1 if there is none.
    /// @param at  any voxel index, of which the lowest three bits are used
    [[nodiscard]] std::int64_t find(Vec3i at) const {
        const std::int32_t number = mask.find(at);
        return number < 0 ? -1 : static_cast<std::int64_t>(first_voxel) + number;
    }
};

/// One level of an object in the layout that rays traverse: leaves of 8^3 voxels in a LeafTable, so
/// that rays skip 64 or 8 empty voxels at a time.
///
/// Memory: 8 bytes per voxel, 8 per lobe, 96 per leaf, the LeafTable, and the optional arrays, of
/// which the sheets take 16 bytes per voxel.
class TraversalLevel {
public:
    /// Copies the data of `source`, which need not outlive this object.
    /// @param parents  the level above it, whose coverage tells how far voxels behind each other
    ///                 cover the same, if the file has no correlation; null: unknown
    explicit TraversalLevel(const VoxelLevel& source, const VoxelLevel* parents = nullptr);

    [[nodiscard]] const VoxelLevelInfo& info() const { return info_; }
    /// Bounds of the indices of all voxels: [lo, hi).
    [[nodiscard]] Vec3i lo() const { return lo_; }
    [[nodiscard]] Vec3i hi() const { return hi_; }

    /// A leaf, or the size of the empty cube around a voxel index.
    struct LeafLookup {
        const TraversalLeaf* leaf = nullptr;
        std::int32_t size = 64; ///< if there is no leaf: edge of the aligned empty cube, voxels
    };
    [[nodiscard]] LeafLookup find_leaf(Vec3i at) const {
        const LeafTable<3>::LeafLookup place = table_.find(at);
        return {place.leaf == LeafTable<3>::kNone ? nullptr : &leaves_[place.leaf], place.size};
    }

    /// Returns true if the cells of its voxels are known (cell_columns.h): all materials are
    /// fibers, and the file has them.
    [[nodiscard]] bool has_cells() const { return !cells_.empty(); }
    /// The cells of a voxel of a level that has them.
    [[nodiscard]] std::uint64_t cells(std::int64_t v) const {
        return cells_[static_cast<std::size_t>(v)];
    }
    /// The extinctions of these cells along the axes.
    [[nodiscard]] std::array<CellExtinction, 3> extinction(std::int64_t v) const {
        const std::array<std::uint16_t, 3>& bits = voxel(v).depth;
        return {CellExtinction{bits[0]}, CellExtinction{bits[1]}, CellExtinction{bits[2]}};
    }
    /// Returns the diameter of what blocks rays, in diameters of a fiber: 1 where fibers stand
    /// alone, more where they are behind each other, so that a voxel's coverage tells only of their
    /// bundle.
    [[nodiscard]] float crowding() const { return crowding_; }
    /// Returns the transmittance of what blocks rays: of so many fibers behind each other, all but
    /// the first one.
    [[nodiscard]] float bundle_transmittance() const { return bundle_transmittance_; }
    /// Returns the mean area of a cell's faces.
    [[nodiscard]] float cell_section() const { return cell_section_; }
    /// Returns -ln(1 - coverage) of a voxel along each axis.
    [[nodiscard]] Vec3f depths(std::int64_t v) const;

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
    /// Means of the maps in the lobe; null if the level has none.
    [[nodiscard]] const LobeMaps* maps(std::size_t l) const {
        return maps_.empty() ? nullptr : &maps_[l];
    }
    [[nodiscard]] const PackedSggx* tangent(std::size_t l) const {
        return tangents_.empty() ? nullptr : &tangents_[l];
    }
    [[nodiscard]] bool has_sheets() const { return !sheets_.empty(); }
    /// @param v  a voxel of a level that has sheets
    [[nodiscard]] const SheetVoxel& sheet(std::int64_t v) const {
        return sheets_[static_cast<std::size_t>(v)];
    }
    [[nodiscard]] std::int64_t byte_count() const;

private:
    void append(const VoxelBlock& block,
                const std::vector<std::uint16_t>& depth_of_coverage,
                IndexBox& box);
    /// Replaces the depths of all voxels by the extinctions of their cells.
    /// @param origins      of the leaves
    /// @param correlation  VoxelBlock::correlation of all voxels; may be empty
    void fit_cells(const std::vector<Vec3i>& origins,
                   const std::vector<std::array<std::uint8_t, 3>>& correlation);
    /// Sets crowding_.
    /// @param extinction  of the cells, per voxel and axis
    void find_crowding(const std::vector<std::array<float, 3>>& extinction);
    /// Returns VoxelBlock::correlation of all voxels as the coverage of their parents tells it.
    [[nodiscard]] std::vector<std::array<std::uint8_t, 3>>
    correlate(const VoxelLevel& parents) const;
    /// Returns the number of the voxel after the one at `at` along an axis; -1 if there is none.
    [[nodiscard]] std::int64_t next_voxel(Vec3i at, int axis) const;
    void append_sheets(const VoxelBlock& block, std::size_t first_voxel);

    VoxelLevelInfo info_;
    bool fibers_only_ = true;
    float crowding_ = 1.0f;
    float bundle_transmittance_ = 1.0f;
    float cell_section_ = 1.0f;
    std::uint64_t occupancy_ = 0; ///< sum of Coverage::occupancy
    Vec3i lo_{}, hi_{};
    LeafTable<3> table_;
    std::vector<TraversalLeaf> leaves_; ///< in the order of the table's numbers
    std::vector<TraversalVoxel> voxels_;
    std::vector<Lobe> lobes_;
    std::vector<LobeMaps> maps_;
    std::vector<PackedSggx> tangents_;
    std::vector<std::uint64_t> cells_;
    std::vector<SheetVoxel> sheets_;
};

} // namespace heddle
