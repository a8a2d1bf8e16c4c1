#pragma once

#include <heddle/base/vec.h>
#include <heddle/voxel/voxel_grid.h>

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace heddle {

/// One unit of VolumeVoxel::depth in optical depth: coverage is at most 1 - 1 / 2^21 at level 8, so
/// depths end below 16.
inline constexpr float kDepthUnit = 16.0f / 65535.0f;

/// What a ray needs of a voxel that it only passes: one 8-byte read.
struct VolumeVoxel {
    std::array<std::uint16_t, 3> depth{}; ///< -ln(1 - coverage) along each axis, in kDepthUnit
    std::uint16_t lobe_place = 0; ///< its first lobe in the leaf's, 12 bits, and lobes - 1 above
};
static_assert(sizeof(VolumeVoxel) == 8);

/// 8 x 8 x 8 voxels.
struct VolumeLeaf {
    std::array<std::uint64_t, 8> active{}; ///< as VoxelLeaf::active
    std::array<std::uint16_t, 8> before{}; ///< voxels of the leaf before word x
    std::uint64_t first_voxel = 0;
    std::uint64_t first_lobe = 0;

    /// Number of a voxel in the level's arrays; -1 where none is.
    /// @param at  any index: its lowest three bits count
    [[nodiscard]] std::int64_t find(Vec3i at) const {
        const auto x = static_cast<std::size_t>(at.x & 7);
        const int bit = (at.y & 7) * 8 + (at.z & 7);
        const std::uint64_t word = active[x] >> bit;
        if ((word & 1) == 0) return -1;
        const int inside = std::popcount(active[x] & ((std::uint64_t{1} << bit) - 1));
        return static_cast<std::int64_t>(first_voxel) + before[x] + inside;
    }
};

/// One level of an object as rays walk it: tiles of 8^3 leaves of 8^3 voxels.
///
/// A hash table names the tile, two rounds of masks the leaf and the voxel: emptiness is skipped a
/// tile or a leaf at a time. Memory: 8 bytes a voxel, 8 a lobe, 96 a leaf, and the optional arrays.
class VolumeLevel {
public:
    /// Copies what `source` holds; it may be dropped then.
    explicit VolumeLevel(const VoxelSource& source);

    [[nodiscard]] const VoxelGridInfo& info() const { return info_; }
    /// Voxel indices that hold all voxels: [lo, hi).
    [[nodiscard]] Vec3i lo() const { return lo_; }
    [[nodiscard]] Vec3i hi() const { return hi_; }

    /// What is at a voxel index: a leaf, or how much around it is empty.
    struct Place {
        const VolumeLeaf* leaf = nullptr;
        std::int32_t size = 64; ///< without leaf: edge of the aligned cube that is empty
    };
    [[nodiscard]] Place find_leaf(Vec3i at) const;

    [[nodiscard]] const VolumeVoxel& voxel(std::int64_t v) const {
        return voxels_[static_cast<std::size_t>(v)];
    }
    /// First lobe and number of lobes of voxel `v` of `leaf`.
    struct LobeRange {
        std::size_t first, count;
    };
    [[nodiscard]] LobeRange lobes_of(const VolumeLeaf& leaf, std::int64_t v) const {
        const std::uint16_t place = voxel(v).lobe_place;
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
    /// log2 of the voxel's longest edge over the thinnest fiber's radius; 0 where no radius is known.
    [[nodiscard]] float fibers_across() const { return fibers_across_; }
    [[nodiscard]] bool has_footprints() const { return !footprints_.empty(); }
    /// Footprints of 4 x 4 cells along x, y, z, 16 bits each from the lowest on: bit 4 b + a, a and b
    /// the cell's place on the next two axes.
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
    /// 8 x 8 x 8 leaves.
    struct Tile {
        Vec3i origin; ///< voxel index / 64
        std::uint32_t first_leaf = 0;
        std::array<std::uint64_t, 8> active{};
        std::array<std::uint16_t, 8> before{};
    };
    static constexpr std::uint32_t kNone = 0xffffffff;

    void append(const VoxelBlock& block, const std::vector<std::uint16_t>& depth_of_coverage);
    void sort_leaves(std::vector<Vec3i>& origins);
    void grow_bounds(Vec3i origin, const VolumeLeaf& leaf);
    void build_tiles(const std::vector<Vec3i>& origins);
    [[nodiscard]] static std::uint32_t hash(Vec3i tile);

    VoxelGridInfo info_;
    bool fibers_only_ = true;
    float fibers_across_ = 0.0f;
    Vec3i lo_{}, hi_{};
    std::vector<std::uint32_t> slots_;
    std::vector<Tile> tiles_;
    std::vector<VolumeLeaf> leaves_;
    std::vector<Vec3i> origins_; ///< of the leaves while they are collected
    std::vector<VolumeVoxel> voxels_;
    std::vector<Lobe> lobes_;
    std::vector<LobeMaps> maps_;
    std::vector<PackedSggx> tangents_;
    std::vector<std::uint64_t> footprints_;
    std::vector<std::array<std::uint8_t, 3>> correlation_;
};

inline std::uint32_t VolumeLevel::hash(Vec3i tile) {
    const auto word = [](std::int32_t v) { return static_cast<std::uint32_t>(v); };
    std::uint32_t h = word(tile.x) * 73856093u ^ word(tile.y) * 19349663u ^
                      word(tile.z) * 83492791u; // [Teschner 2003]
    h ^= h >> 15;
    h *= 0x2c1b3c6du;
    return h ^ h >> 13;
}

inline VolumeLevel::Place VolumeLevel::find_leaf(Vec3i at) const {
    const Vec3i t{at.x >> 6, at.y >> 6, at.z >> 6};
    const auto mask = static_cast<std::uint32_t>(slots_.size() - 1);
    for (std::uint32_t i = hash(t) & mask; slots_[i] != kNone; i = (i + 1) & mask) {
        const Tile& tile = tiles_[slots_[i]];
        if (!(tile.origin == t)) continue;
        const auto x = static_cast<std::size_t>(at.x >> 3 & 7);
        const int bit = (at.y >> 3 & 7) * 8 + (at.z >> 3 & 7);
        if ((tile.active[x] >> bit & 1) == 0) return {nullptr, 8};
        const int inside = std::popcount(tile.active[x] & ((std::uint64_t{1} << bit) - 1));
        return {&leaves_[tile.first_leaf + tile.before[x] + static_cast<std::uint32_t>(inside)], 8};
    }
    return {nullptr, 64};
}

} // namespace heddle
