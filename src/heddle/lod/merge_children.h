#pragma once

#include <heddle/lod/method.h>
#include <heddle/voxel/lobe_pool.h>

#include <array>
#include <cstdint>

namespace heddle {

/// Makes the lobes of a parent from those of its children.
struct MergeOptions {
    LodMethod method = LodMethod::Moments;
    int max_lobes = 3;      ///< K
    bool with_maps = false; ///< LobePool::maps count
};

/// Reduces the children's pooled lobes to the parent's.
/// @param first  where each child's lobes begin in the pool, and the end; children without are
///               empty
/// @param seed   of this parent's random numbers: methods `random` and `wasserstein`
/// @return       VoxelBlock::merge_order
std::uint32_t merge_children(LobePool& pool,
                             const std::array<int, 9>& first,
                             const MergeOptions& options,
                             std::uint64_t seed);

} // namespace heddle
