#pragma once

#include <heddle/voxel/bin.h>
#include <heddle/voxel/fit_block.h>
#include <heddle/voxel/gather_fibers.h>
#include <heddle/voxel/gather_triangles.h>

#include <memory>
#include <mutex>
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

/// Lends workers to whichever thread asks: as many exist as threads ever worked at once.
class WorkerPool {
public:
    explicit WorkerPool(const VoxelizeContext& context) : context_(context) {}

    /// Calls body(worker) with a worker of this thread's own.
    template <typename Body>
    void with(const Body& body) {
        std::unique_ptr<BlockWorker> worker;
        {
            const std::scoped_lock lock(mutex_);
            if (!idle_.empty()) {
                worker = std::move(idle_.back());
                idle_.pop_back();
            }
        }
        if (!worker) worker = std::make_unique<BlockWorker>(context_);
        body(*worker);
        const std::scoped_lock lock(mutex_);
        idle_.push_back(std::move(worker));
    }

private:
    const VoxelizeContext& context_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<BlockWorker>> idle_;
};

} // namespace heddle
