#pragma once

#include <heddle/lod/method.h>
#include <heddle/voxel/lobe_pool.h>

#include <array>
#include <cstdint>

namespace heddle {

/// How the lobes of a parent are merged from those of its children.
struct MergeOptions {
    LodMethod method = LodMethod::Moments;
    int max_lobes = 3;      ///< K
    bool with_maps = false; ///< LobePool::maps is used
};

/// Reduces the children's pooled lobes to the parent's.
/// @param first  the number of each child's first lobe in the pool, and the end; a missing child
///               has no lobes
/// @param seed   seed of this parent's random numbers, for the methods `random` and `wasserstein`
/// @return       VoxelBlock::merge_order
std::uint32_t merge_children(LobePool& pool,
                             const std::array<int, 9>& first,
                             const MergeOptions& options,
                             std::uint64_t seed);

} // namespace heddle
