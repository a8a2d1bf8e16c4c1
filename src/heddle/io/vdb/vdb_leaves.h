#pragma once

#include <heddle/base/progress.h>
#include <heddle/voxel/index_box.h>
#include <heddle/voxel/voxel_level.h>

#include <array>
#include <cstdint>
#include <vector>

namespace heddle {

using LeafMask = std::array<std::uint64_t, 8>; ///< VoxelLeaf::active

/// The source of a leaf of a VDB tree.
struct LeafRef {
    Vec3i origin;
    std::uint32_t block = 0; ///< index in the source
    std::uint32_t leaf = 0;  ///< index in the block
    LeafMask active{};       ///< voxels that are active in the current grid
};

/// All leaves of a source in the order of a VDB tree with 5, 4, 3 bits, and the counts that a
/// writer needs before it starts.
struct VdbLeaves {
    std::vector<LeafRef> leaves;
    IndexBox box; ///< of the active voxels
    std::int64_t voxel_count = 0;
    std::int64_t lobe_count = 0;
    std::int32_t most_lobes = 0;      ///< the largest number of any voxel
    std::int64_t merge_voxels = 0;    ///< voxels with more than two lobes and a merge order
    std::int64_t unmerged_voxels = 0; ///< voxels with more than two lobes and none
    std::int64_t fiber_voxels = 0;    ///< voxels whose heaviest lobe has a fiber material
    std::int64_t surface_voxels = 0;  ///< the other voxels
};

/// Origin of the tree node with voxel index `i`: 12 bits = child of the root, 7 = of 128^3.
[[nodiscard]] constexpr Vec3i node_origin(Vec3i i, int bits) {
    const std::int32_t mask = ~((std::int32_t{1} << bits) - 1);
    return {i.x & mask, i.y & mask, i.z & mask};
}

/// Index of the child that contains voxel index `i`, in a node of 2^`node_bits` voxels per axis
/// whose children have 2^`child_bits`: x slowest, as VDB numbers them.
[[nodiscard]] constexpr std::uint32_t child_offset(Vec3i i, int node_bits, int child_bits) {
    const int width = node_bits - child_bits;
    const auto part = [&](std::int32_t v) {
        return (static_cast<std::uint32_t>(v) >> child_bits) & ((1u << width) - 1u);
    };
    return (((part(i.x) << width) | part(i.y)) << width) | part(i.z);
}

/// Visits the source once, on all threads.
/// @throws Error  Internal: two blocks have the same leaf, an array does not have the length that
///                its block's fields say, or only some voxels have a merge order; Cancelled
[[nodiscard]] VdbLeaves list_vdb_leaves(const VoxelLevel& source, const Progress& progress);

} // namespace heddle
