#pragma once

#include <heddle/base/progress.h>
#include <heddle/preview/preview.h>
#include <heddle/voxel/voxel_grid.h>

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace heddle::preview {

/// What a ray needs of a voxel.
struct Voxel {
    std::array<std::uint8_t, 3> depth; ///< -ln(1 - c_a) by axis, 255 = kMaxDepth
    std::uint8_t width;                ///< of the heaviest lobe, 255 = round
    std::array<std::uint8_t, 3> color; ///< sRGB-like: square root of linear
    std::array<std::int8_t, 3> axis;   ///< heaviest lobe's direction, 127 = 1
    std::uint8_t material;             ///< of the heaviest lobe
    std::uint8_t flags; ///< bit 3: fiber; bits 0 to 2: the normal is < 0 on that axis

    [[nodiscard]] bool is_fiber() const { return (flags & 8) != 0; }
    [[nodiscard]] bool is_negative(int a) const { return (flags >> a & 1) != 0; }
};
static_assert(sizeof(Voxel) == 12);

inline constexpr float kMaxDepth = 4.8520302f; ///< -ln(1/128): what 64 columns can tell from opaque

struct Leaf {
    std::array<std::uint64_t, 8> active{}; ///< as VoxelLeaf::active
    std::array<std::uint16_t, 8> before{}; ///< voxels of the leaf before word x
    std::uint32_t first = 0;               ///< its first voxel, in its block's list
    std::uint32_t block = 0;
};

/// Leaves found by index: two levels, cells of 16^3 leaves that are there or not.
class Scene {
public:
    /// @param tangents  anisotropic surfaces give the direction of their brushing, not the normal
    /// @throws Error    Cancelled
    Scene(const VoxelSource& source, bool tangents, Progress& progress);

    [[nodiscard]] bool empty() const { return leaves_.empty(); }
    [[nodiscard]] Vec3i lo() const { return lo_; } ///< first leaf, in leaves
    [[nodiscard]] Vec3i hi() const { return hi_; } ///< last leaf, inclusive
    [[nodiscard]] const Vec3d& voxel_size() const { return voxel_size_; }
    /// Bounds of the active voxels, scene units.
    [[nodiscard]] Vec3d bounds_lo() const { return bounds_lo_; }
    [[nodiscard]] Vec3d bounds_hi() const { return bounds_hi_; }

    /// The cell of 16^3 leaves at cell index `c`; -1 where it is empty.
    [[nodiscard]] std::int32_t cell(Vec3i c) const {
        const Vec3i i = c - cell_lo_;
        if (i.x < 0 || i.y < 0 || i.z < 0 || i.x >= cells_.x || i.y >= cells_.y ||
            i.z >= cells_.z) {
            return -1;
        }
        return cell_table_[(static_cast<std::size_t>(i.x) * static_cast<std::size_t>(cells_.y) +
                            static_cast<std::size_t>(i.y)) *
                               static_cast<std::size_t>(cells_.z) +
                           static_cast<std::size_t>(i.z)];
    }
    /// The leaf at leaf index `l` of a cell that is there; null where it is empty.
    [[nodiscard]] const Leaf* leaf(std::int32_t cell, Vec3i l) const {
        const std::uint32_t at =
            leaf_table_[static_cast<std::size_t>(cell) * 4096 +
                        static_cast<std::size_t>(((l.x & 15) << 8) | ((l.y & 15) << 4) |
                                                 (l.z & 15))];
        return at == 0 ? nullptr : &leaves_[at - 1];
    }
    /// Voxel `bit` of word `x` of a leaf; it is active.
    [[nodiscard]] const Voxel& voxel(const Leaf& leaf, int x, int bit) const {
        const std::uint64_t below =
            leaf.active[static_cast<std::size_t>(x)] & ((std::uint64_t{1} << bit) - 1);
        return voxels_[leaf.block][leaf.first + leaf.before[static_cast<std::size_t>(x)] +
                                   static_cast<std::uint32_t>(std::popcount(below))];
    }

    /// The tables as they lie, for what copies them: cells of 16^3 leaves in a box of `cells()` from
    /// cell `cell_lo()` on, z fastest: numbers, -1 where empty.
    [[nodiscard]] std::span<const std::int32_t> cell_table() const { return cell_table_; }
    [[nodiscard]] Vec3i cell_lo() const { return cell_lo_; }
    [[nodiscard]] Vec3i cells() const { return cells_; }
    /// 4096 a cell, x slowest: leaf + 1, 0 where there is none.
    [[nodiscard]] std::span<const std::uint32_t> leaf_table() const { return leaf_table_; }
    [[nodiscard]] std::span<const Leaf> leaves() const { return leaves_; }
    [[nodiscard]] std::span<const std::vector<Voxel>> voxels_by_block() const { return voxels_; }

private:
    void place_leaves(const std::vector<std::vector<VoxelLeaf>>& blocks);

    Vec3d voxel_size_;
    Vec3d bounds_lo_, bounds_hi_;
    Vec3i lo_, hi_, cell_lo_, cells_;
    std::vector<std::int32_t> cell_table_;
    std::vector<std::uint32_t> leaf_table_; ///< 4096 a cell: leaf + 1, 0 = none
    std::vector<Leaf> leaves_;
    std::vector<std::vector<Voxel>> voxels_; ///< by block
};

} // namespace heddle::preview
