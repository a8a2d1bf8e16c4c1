#pragma once

#include <heddle/base/lender.h>
#include <heddle/voxelize/bin.h>
#include <heddle/voxelize/block/fit_block.h>
#include <heddle/voxelize/fiber/gather_fibers.h>
#include <heddle/voxelize/triangle/gather_triangles.h>
#include <heddle/voxelize/voxelize_options.h>

#include <memory>
#include <span>
#include <vector>

namespace heddle {

/// All that one voxelization shares: made once, read by every thread.
struct VoxelizeContext {
    const Geometry& geometry;
    const VoxelizeOptions& options;
    LatticeUnits units;
    FiberSource fibers;
    TriangleSource triangles;
    SurfaceSource surfaces;
    Lattice lattice;
    BlockRange range;
    FitOptions fit;

    VoxelizeContext(const Geometry& geometry,
                    const VoxelizeOptions& options,
                    const Lattice& lattice,
                    Vec3i voxel_lo,
                    Vec3i voxel_hi);

    /// What is known of the result before it is there.
    [[nodiscard]] VoxelGridInfo info() const;
};

/// Turns one block's primitives into voxels; keeps its memory from block to block.
class BlockWorker {
public:
    explicit BlockWorker(const VoxelizeContext& context);

    /// @param block  number in the context's range
    BlockCounts run(std::uint64_t block,
                    std::span<const Primitive> primitives,
                    const Progress& progress,
                    VoxelBlock& out);

    /// Resident bytes of one worker.
    [[nodiscard]] static std::int64_t byte_count(const FitOptions& fit);

private:
    const VoxelizeContext& context_;
    BlockSums sums_;
    FiberGatherer fibers_;
    TriangleGatherer triangles_;
};

/// Workers for whichever thread asks.
class WorkerPool {
public:
    explicit WorkerPool(const VoxelizeContext& context) : context_(context) {}

    /// Calls body(worker) with a worker of this thread's own.
    template <typename Body>
    void with(const Body& body) {
        workers_.with([&] { return std::make_unique<BlockWorker>(context_); }, body);
    }

private:
    const VoxelizeContext& context_;
    Lender<BlockWorker> workers_;
};

} // namespace heddle
