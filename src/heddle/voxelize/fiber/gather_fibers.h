#pragma once

#include <heddle/base/progress.h>
#include <heddle/voxelize/block/accumulator.h>
#include <heddle/voxelize/block/gather_options.h>
#include <heddle/voxelize/chord/fiber_chords.h>
#include <heddle/yarn/fiber_source.h>
#include <heddle/yarn/piece_id.h>

#include <cstdint>
#include <memory>
#include <span>

namespace heddle {

/// Expands yarns to fibers and adds them to blocks. Each thread needs its own: it caches the fibers
/// of the last yarn.
class FiberGatherer {
public:
    FiberGatherer(const FiberSource& source,
                  const LatticeUnits& units,
                  const GatherOptions& options);
    ~FiberGatherer();
    FiberGatherer(const FiberGatherer&) = delete;
    FiberGatherer& operator=(const FiberGatherer&) = delete;
    FiberGatherer(FiberGatherer&&) = delete;
    FiberGatherer& operator=(FiberGatherer&&) = delete;

    /// Adds all fibers of the pieces to the block's voxels.
    /// @throws Error  Cancelled
    void gather(std::span<const PieceId> pieces, BlockSums& block, const Progress& progress);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace heddle
