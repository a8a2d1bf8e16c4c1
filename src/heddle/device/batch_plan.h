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

/// Pairs of a kind, of each block of a range.
using PairCounts = std::array<std::vector<std::uint32_t>, kPrimitiveKinds>;

/// Numbers of the blocks that have pairs, ascending.
[[nodiscard]] std::vector<std::uint32_t> occupied_blocks(const PairCounts& counts);

/// Some blocks that follow each other in a BlockOrder.
struct BatchRange {
    std::size_t begin = 0, end = 0;
};

/// What decides how much a block takes.
struct BatchNeeds {
    std::int64_t materials = 1; ///< of the geometry
    BatchOptions made;          ///< of its level 0
};

/// Bytes of device memory that blocks take while they are a batch, by what is known before: sums,
/// pairs, and the voxels that blocks of cloth have.
[[nodiscard]] std::int64_t
predict_batch_bytes(std::int64_t blocks,
                    const std::array<std::int64_t, kPrimitiveKinds>& pairs,
                    const BatchNeeds& needs);

/// Cuts an order of blocks into batches.
/// @param bytes          that a batch may take; a block that takes more is a batch of its own
/// @param least_batches  at least so many, where there are as many blocks
[[nodiscard]] std::vector<BatchRange> plan_batches(const BlockOrder& order,
                                                   const PairCounts& counts,
                                                   const BatchNeeds& needs,
                                                   std::int64_t bytes,
                                                   std::int64_t least_batches);

} // namespace heddle
