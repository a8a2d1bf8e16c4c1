#pragma once

#include <heddle/base/progress.h>
#include <heddle/leaf_table/leaf_table.h>
#include <heddle/leaf_table/ranked_mask.h>
#include <heddle/preview/preview.h>
#include <heddle/voxel/voxel_level.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace heddle::preview {

/// The data of a voxel that a ray needs.
struct PreviewVoxel {
    std::array<std::uint8_t, 3> depth; ///< -ln(1 - c_a) by axis, 255 = kMaxDepth
    std::uint8_t width;                ///< of the heaviest lobe, 255 = isotropic
    std::array<std::uint8_t, 3> color; ///< sRGB-like: square root of linear
    std::array<std::int8_t, 3> axis;   ///< heaviest lobe's direction, 127 = 1
    std::uint8_t material;             ///< of the heaviest lobe
    std::uint8_t flags; ///< bit 3: fiber; bits 0 to 2: the normal is < 0 on that axis

    [[nodiscard]] bool is_fiber() const { return (flags & 8) != 0; }
    [[nodiscard]] bool is_negative(int a) const { return (flags >> a & 1) != 0; }
};
static_assert(sizeof(PreviewVoxel) == 12);

inline constexpr float kMaxDepth = 4.8520302f; ///< -ln(1/128): what 64 columns can tell from opaque

struct PreviewLeaf {
    RankedMask mask;
    std::uint32_t first = 0; ///< its first voxel, in its block's list
    std::uint32_t block = 0;
};

/// The voxels of a level in the layout that rays of the preview and the viewer traverse: a
/// LeafTable with tiles of 16^3 leaves.
class PreviewVolume {
public:
    using Table = LeafTable<4>;
    /// @param tangents  for anisotropic surfaces, stores the direction of brushing, not the normal
    /// @throws Error    Cancelled
    PreviewVolume(const VoxelLevel& source, bool tangents, Progress& progress);

    [[nodiscard]] bool empty() const { return leaves_.empty(); }
    [[nodiscard]] Vec3i lo() const { return lo_; } ///< first leaf, in leaves
    [[nodiscard]] Vec3i hi() const { return hi_; } ///< last leaf, inclusive
    [[nodiscard]] const Vec3d& voxel_size() const { return voxel_size_; }
    /// Bounds of the active voxels, scene units.
    [[nodiscard]] Vec3d bounds_lo() const { return bounds_lo_; }
    [[nodiscard]] Vec3d bounds_hi() const { return bounds_hi_; }

    /// Maps voxel indices to numbers of leaves.
    [[nodiscard]] const Table& table() const { return table_; }
    /// Returns the leaf at leaf index `l` in a tile of the table; null if there is none.
    [[nodiscard]] const PreviewLeaf* leaf(std::uint32_t tile, Vec3i l) const {
        const std::uint32_t number = table_.find_in_tile(tile, l * 8);
        return number == Table::kNone ? nullptr : &leaves_[number];
    }
    /// Returns the PreviewVoxel of a leaf's active voxel `number`.
    [[nodiscard]] const PreviewVoxel& voxel(const PreviewLeaf& leaf, std::int32_t number) const {
        return voxels_[leaf.block][leaf.first + static_cast<std::uint32_t>(number)];
    }
    /// Leaves in the order of the table's numbers.
    [[nodiscard]] std::span<const PreviewLeaf> leaves() const { return leaves_; }
    [[nodiscard]] std::span<const std::vector<PreviewVoxel>> voxels_by_block() const {
        return voxels_;
    }

private:
    void add_leaves(std::span<const VoxelLeaf> leaves, std::uint32_t block);

    Vec3d voxel_size_;
    Vec3d bounds_lo_, bounds_hi_;
    Vec3i lo_, hi_;
    Table table_;
    std::vector<PreviewLeaf> leaves_;               ///< by the table's numbers
    std::vector<std::vector<PreviewVoxel>> voxels_; ///< by block
};

} // namespace heddle::preview
