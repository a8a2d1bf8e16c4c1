#pragma once

#include <heddle/voxel/voxel_level.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace heddle {

/// A voxel of a block, as for_each_voxel() passes it. It is valid during that call only.
struct BlockVoxel {
    Vec3i at;                ///< its index in the level's lattice
    const VoxelBlock& block; ///< the block that contains it
    std::size_t voxel = 0;   ///< its number in the block's arrays per voxel
    std::size_t lobe = 0;    ///< number of its first lobe in the block's arrays per lobe

    [[nodiscard]] const Coverage& coverage() const { return block.coverage[voxel]; }
    [[nodiscard]] std::size_t lobe_count() const { return block.lobe_count[voxel]; }
    // These return zeros if the block does not have the field.
    [[nodiscard]] std::uint32_t merge_order() const { return of_voxel(block.merge_order); }
    [[nodiscard]] std::array<std::uint64_t, 3> columns() const { return of_voxel(block.columns); }
    [[nodiscard]] std::array<std::uint64_t, 3> footprints() const {
        return of_voxel(block.footprints);
    }
    [[nodiscard]] std::array<std::uint8_t, 3> correlation() const {
        return of_voxel(block.correlation);
    }
    [[nodiscard]] std::uint64_t occupancy() const { return of_voxel(block.occupancy); }
    /// {0, 255} if the block does not have the field.
    [[nodiscard]] PlaneSlab slab() const { return of_voxel(block.slabs); }
    /// Returns its 1 to K lobes, the heaviest first.
    [[nodiscard]] std::span<const Lobe> lobes() const { return of_lobes(block.lobes); }
    /// These return one element per lobe; empty if the block does not have the field.
    [[nodiscard]] std::span<const LobeMaps> maps() const { return of_lobes(block.maps); }
    [[nodiscard]] std::span<const PackedSggx> tangents() const { return of_lobes(block.tangents); }
    [[nodiscard]] std::span<const LobeMoment> moments() const { return of_lobes(block.moments); }

private:
    template <typename T>
    [[nodiscard]] T of_voxel(const std::vector<T>& array) const {
        return array.empty() ? T{} : array[voxel];
    }
    template <typename T>
    [[nodiscard]] std::span<const T> of_lobes(const std::vector<T>& array) const {
        if (array.empty()) return {};
        return {array.data() + lobe, lobe_count()};
    }
};

/// Calls visit(x, bit) for each active voxel (x, bit / 8, bit % 8) of a leaf, in ascending order.
/// @param active  mask of the leaf, laid out as VoxelLeaf::active
template <typename Visit>
void for_each_active(const std::array<std::uint64_t, 8>& active, const Visit& visit) {
    for (std::size_t x = 0; x < 8; ++x) {
        for (std::uint64_t word = active[x]; word != 0; word &= word - 1) {
            visit(x, std::countr_zero(word));
        }
    }
}

/// Returns the index of a voxel that for_each_active() passes.
/// @param origin  origin of its leaf
[[nodiscard]] inline Vec3i voxel_index(Vec3i origin, std::size_t x, int bit) {
    return origin + Vec3i{static_cast<std::int32_t>(x), bit >> 3, bit & 7};
}

/// Calls visit(BlockVoxel) for each voxel of a leaf, in the order of the block's arrays: ascending
/// (x, y, z).
/// @param leaf  a leaf of the block
template <typename Visit>
void for_each_voxel(const VoxelBlock& block, const VoxelLeaf& leaf, const Visit& visit) {
    std::size_t voxel = leaf.first_voxel;
    std::size_t lobe = leaf.first_lobe;
    for_each_active(leaf.active, [&](std::size_t x, int bit) {
        visit(BlockVoxel{voxel_index(leaf.origin, x, bit), block, voxel, lobe});
        lobe += block.lobe_count[voxel++];
    });
}

/// Calls visit(BlockVoxel) for each voxel of a block, leaf by leaf.
template <typename Visit>
void for_each_voxel(const VoxelBlock& block, const Visit& visit) {
    for (const VoxelLeaf& leaf : block.leaves) for_each_voxel(block, leaf, visit);
}

/// Calls visit(BlockVoxel) for each voxel of a level, block by block in the level's order.
template <typename Visit>
void for_each_voxel(const VoxelLevel& source, const Visit& visit) {
    VoxelBlock scratch;
    for (std::size_t b = 0; b < source.block_count(); ++b) {
        for_each_voxel(source.block(b, scratch), visit);
    }
}

} // namespace heddle
