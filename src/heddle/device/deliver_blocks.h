#pragma once

#include <heddle/device/level/batch_levels.h>
#include <heddle/device/level/dense_sums.h>
#include <heddle/lod/build_levels.h>
#include <heddle/voxel/block_sink.h>
#include <heddle/voxelize/block/fit_options.h>

#include <cstddef>
#include <span>

namespace heddle {

/// Returns what to build from a batch's level 0: all levels if the builder accepts built levels,
/// else level 0 with the sums from which the builder builds them.
/// @param levels  after begin(); null: no levels above 0 are needed
[[nodiscard]] BatchOptions batch_options(const FitOptions& fit, const LevelBuilder* levels);

/// Passes a batch's blocks to the sink and to the level builder, from several threads.
/// @param built   result of build_batch_levels() with batch_options()
/// @param first   rank of the batch's first block
/// @param blocks  blocks of the batch
/// @param sink    its visitor is `levels`
/// @param levels  may be null
void deliver_blocks(const BatchLevels& built,
                    std::size_t first,
                    std::span<const BatchBlock> blocks,
                    BlockSink& sink,
                    LevelBuilder* levels);

} // namespace heddle
