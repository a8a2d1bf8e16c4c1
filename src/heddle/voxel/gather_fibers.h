#pragma once

#include <heddle/base/progress.h>
#include <heddle/voxel/accumulator.h>
#include <heddle/voxel/fiber_chords.h>
#include <heddle/voxel/fiber_source.h>
#include <heddle/voxel/voxelize.h>

#include <cstdint>
#include <memory>
#include <span>

namespace heddle {

/// A piece of a span that reaches into a block: span << 16 | part.
using PieceId = std::uint64_t;

/// Expands yarns to fibers and adds them to blocks. One per thread: it keeps the last yarn's fibers.
class FiberGatherer {
public:
    FiberGatherer(const FiberSource& source, const VoxelizeOptions& options);
    ~FiberGatherer();
    FiberGatherer(const FiberGatherer&) = delete;
    FiberGatherer& operator=(const FiberGatherer&) = delete;
    FiberGatherer(FiberGatherer&&) = delete;
    FiberGatherer& operator=(FiberGatherer&&) = delete;

    /// Adds all fibers of the pieces to the block's voxels.
    /// @throws Error  Cancelled
    void gather(std::span<const PieceId> pieces, BlockSums& block, const Progress& progress);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace heddle
