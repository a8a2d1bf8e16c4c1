#pragma once

#include <heddle/base/object_pool.h>
#include <heddle/voxelize/block/fit_block.h>
#include <heddle/voxelize/fiber/gather_fibers.h>
#include <heddle/voxelize/prepare.h>
#include <heddle/voxelize/triangle/gather_triangles.h>
#include <heddle/voxelize/voxelize_options.h>

#include <memory>
#include <span>
#include <vector>

namespace heddle {

/// All that one voxelization shares: read by every thread.
struct VoxelizeContext {
    const PreparedGeometry& prepared;
    const VoxelizeOptions& options;
    FitOptions fit;

    /// @param with_sums  finished blocks have their sums, for a BlockVisitor, also where the result
    ///                   does not hold them
    VoxelizeContext(const PreparedGeometry& prepared,
                    const VoxelizeOptions& options,
                    bool with_sums = false);

    /// Which optional data the result holds.
    [[nodiscard]] VoxelFields fields() const;
    /// What is known of the result before it is there.
    [[nodiscard]] VoxelLevelInfo info() const;
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
    ObjectPool<BlockWorker> workers_;
};

} // namespace heddle
