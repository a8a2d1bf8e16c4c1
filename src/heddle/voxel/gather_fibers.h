#pragma once

#include <heddle/base/progress.h>
#include <heddle/voxel/accumulator.h>
#include <heddle/voxel/fiber_source.h>
#include <heddle/voxel/voxelize.h>

#include <cstdint>
#include <memory>
#include <span>

namespace heddle {

/// Largest sagitta of a chord, in units (subvoxel edges). The samples between chords are moved outwards,
/// in yarns so that a chord's mean distance from its fiber is 0 (then at most 2/3 of this: coverage of
/// bundles is unbiased), in single curves half as far, so that it is as long as its arc (their volume
/// is right).                                                              [bench/results/exact.md]
constexpr double kChordSagitta = 1.0 / 2.0;

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
