#pragma once

#include <heddle/base/progress.h>
#include <heddle/voxel/index_box.h>
#include <heddle/voxel/voxel_grid.h>

#include <array>
#include <cstdint>
#include <vector>

namespace heddle {

using LeafMask = std::array<std::uint64_t, 8>; ///< VoxelLeaf::active

/// Where a leaf of a VDB tree comes from.
struct LeafRef {
    Vec3i origin;
    std::uint32_t block = 0; ///< of the source
    std::uint32_t leaf = 0;  ///< of the block
    LeafMask active{};       ///< voxels that are active in the grid at hand
};

/// All leaves of a source in the order in which a VDB tree of 5, 4, 3 bits holds them, and what a
/// writer must know before it starts.
struct VdbLeaves {
    std::vector<LeafRef> leaves;
    IndexBox box; ///< of the active voxels
    std::int64_t voxel_count = 0;
    std::int64_t lobe_count = 0;
    std::int32_t most_lobes = 0;      ///< of any voxel
    std::int64_t merge_voxels = 0;    ///< with more than two lobes and a merge order
    std::int64_t unmerged_voxels = 0; ///< with more than two lobes and none
    std::int64_t fiber_voxels = 0;    ///< whose heaviest lobe is of a fiber material
    std::int64_t surface_voxels = 0;  ///< the others
};

/// Origin of the tree's node that holds voxel index `i`: 12 bits = child of the root, 7 = of 128^3.
[[nodiscard]] constexpr Vec3i node_origin(Vec3i i, int bits) {
    const std::int32_t mask = ~((std::int32_t{1} << bits) - 1);
    return {i.x & mask, i.y & mask, i.z & mask};
}

/// Position of voxel index `i`'s child in a node of 2^`node_bits` voxels per axis, whose children
/// have 2^`child_bits`: x slowest, as VDB numbers them.
[[nodiscard]] constexpr std::uint32_t child_offset(Vec3i i, int node_bits, int child_bits) {
    const int width = node_bits - child_bits;
    const auto part = [&](std::int32_t v) {
        return (static_cast<std::uint32_t>(v) >> child_bits) & ((1u << width) - 1u);
    };
    return (((part(i.x) << width) | part(i.y)) << width) | part(i.z);
}

/// Walks the source once, on all threads.
/// @throws Error  Internal when two blocks hold the same leaf, an array is not as long as its
///                block's fields say, or only some voxels have a merge order; Cancelled
[[nodiscard]] VdbLeaves list_vdb_leaves(const VoxelSource& source, const Progress& progress);

} // namespace heddle
