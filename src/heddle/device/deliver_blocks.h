#pragma once

#include <heddle/device/level/batch_levels.h>
#include <heddle/device/level/dense_sums.h>
#include <heddle/lod/build_levels.h>
#include <heddle/voxel/block_sink.h>
#include <heddle/voxelize/block/fit_options.h>

#include <cstddef>
#include <span>

namespace heddle {

/// What is to be made of a batch's level 0: all levels if the builder takes them built, else level
/// 0 with the sums that it builds them from.
/// @param levels  after begin(); null: no levels above 0 are wanted
[[nodiscard]] BatchOptions batch_options(const FitOptions& fit, const LevelBuilder* levels);

/// Hands a batch's blocks on, several threads at a time.
/// @param built   by build_batch_levels() with batch_options()
/// @param first   rank of the batch's first block
/// @param blocks  of the batch
/// @param sink    has `levels` for its visitor
/// @param levels  may be null
void deliver_blocks(const BatchLevels& built,
                    std::size_t first,
                    std::span<const BatchBlock> blocks,
                    BlockSink& sink,
                    LevelBuilder* levels);

} // namespace heddle
