#pragma once

#include <heddle/device/block_pairs_op.h>
#include <heddle/device/level/batch_levels.h>
#include <heddle/voxel/voxel_level.h>
#include <heddle/voxelize/block_order.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace heddle {

/// The number of pairs, by kind and by block of a range.
using PairCounts = std::array<std::vector<std::uint32_t>, kPrimitiveKinds>;

/// Returns the numbers of the blocks that have pairs, ascending.
[[nodiscard]] std::vector<std::uint32_t> occupied_blocks(const PairCounts& counts);

/// Consecutive blocks of a BlockOrder.
struct BatchRange {
    std::size_t begin = 0, end = 0;
};

/// What the memory of a block depends on.
struct BatchNeeds {
    std::int64_t materials = 1; ///< number of materials of the geometry
    BatchOptions made;          ///< what is built from its level 0
};

/// Returns the predicted bytes of device memory for a batch of blocks: sums, pairs, and the voxels
/// of typical cloth.
[[nodiscard]] std::int64_t
predict_batch_bytes(std::int64_t blocks,
                    const std::array<std::int64_t, kPrimitiveKinds>& pairs,
                    const BatchNeeds& needs);

/// Divides an order of blocks into batches.
/// @param bytes          memory limit of a batch; a block that needs more is a batch of its own
/// @param least_batches  smallest number of batches, if there are as many blocks
[[nodiscard]] std::vector<BatchRange> plan_batches(const BlockOrder& order,
                                                   const PairCounts& counts,
                                                   const BatchNeeds& needs,
                                                   std::int64_t bytes,
                                                   std::int64_t least_batches);

} // namespace heddle
