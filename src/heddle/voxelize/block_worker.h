#pragma once

#include <heddle/base/object_pool.h>
#include <heddle/voxelize/block/fit_block.h>
#include <heddle/voxelize/fiber/gather_fibers.h>
#include <heddle/voxelize/prepare.h>
#include <heddle/voxelize/triangle/fit_slabs.h>
#include <heddle/voxelize/triangle/gather_triangles.h>
#include <heddle/voxelize/voxelize_options.h>

#include <memory>
#include <span>
#include <vector>

namespace heddle {

/// The data that all threads of one voxelization share and only read.
struct VoxelizeContext {
    const PreparedGeometry& prepared;
    const VoxelizeOptions& options;
    FitOptions fit;

    /// @param with_sums  finished blocks have their sums, for a BlockVisitor, even if the result
    ///                   does not hold them
    VoxelizeContext(const PreparedGeometry& prepared,
                    const VoxelizeOptions& options,
                    bool with_sums = false);

    /// Returns the optional fields of the result.
    [[nodiscard]] VoxelFields fields() const;
    /// Returns the info of the result, without its counts.
    [[nodiscard]] VoxelLevelInfo info() const;
};

/// Turns one block's primitives into voxels. Its memory is reused from block to block.
class BlockWorker {
public:
    explicit BlockWorker(const VoxelizeContext& context);

    /// Voxelizes one block.
    /// @param block  number in the context's range
    /// @throws Error  Cancelled
    BlockCounts run(std::uint64_t block,
                    std::span<const Primitive> primitives,
                    const Progress& progress,
                    VoxelBlock& out);

    /// Returns the resident bytes of one worker.
    [[nodiscard]] static std::int64_t byte_count(const FitOptions& fit);

private:
    const VoxelizeContext& context_;
    BlockSums sums_;
    FiberGatherer fibers_;
    TriangleGatherer triangles_;
    SlabFitter slabs_;
};

/// A pool of workers, one per thread.
class WorkerPool {
public:
    explicit WorkerPool(const VoxelizeContext& context) : context_(context) {}

    /// Calls body(worker) with a worker that no other thread uses meanwhile.
    template <typename Body>
    void with(const Body& body) {
        workers_.with([&] { return std::make_unique<BlockWorker>(context_); }, body);
    }

private:
    const VoxelizeContext& context_;
    ObjectPool<BlockWorker> workers_;
};

} // namespace heddle
