#include <heddle/voxelize/voxelize.h>

#include <heddle/base/parallel.h>
#include <heddle/voxel/block_sink.h>
#include <heddle/voxelize/block_order.h>
#include <heddle/voxelize/block_worker.h>

#include <algorithm>
#include <numeric>

namespace heddle {
namespace {

/// The numbers of some blocks, ascending as Bins::fill() needs them, and the new position of each.
struct SortedBlocks {
    std::vector<std::uint32_t> block;
    std::vector<std::uint32_t> place;

    explicit SortedBlocks(std::span<const std::uint32_t> some) : place(some.size()) {
        std::vector<std::uint32_t> order(some.size());
        std::iota(order.begin(), order.end(), 0u);
        std::sort(order.begin(), order.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return some[a] < some[b]; });
        for (std::uint32_t i = 0; i < order.size(); ++i) {
            block.push_back(some[order[i]]);
            place[order[i]] = i;
        }
    }
};

/// The blocks of an order that are processed with one set of lists.
struct Batch {
    std::size_t begin, end;
};

/// Divides the order into batches with about the same number of primitives.
std::vector<Batch> cut_batches(const BlockOrder& order, const Bins& bins, std::int64_t batches) {
    const std::uint64_t least =
        bins.total_entries() / static_cast<std::uint64_t>(std::max<std::int64_t>(1, batches)) + 1;
    std::vector<Batch> out;
    for (std::size_t begin = 0; begin < order.block.size(); begin = out.back().end) {
        std::size_t end = begin;
        for (std::uint64_t sum = 0; end < order.block.size() && sum < least; ++end) {
            sum += bins.entries(order.block[end]);
        }
        out.push_back({begin, end});
    }
    return out;
}

} // namespace

std::unique_ptr<VoxelLevel> voxelize(const Geometry& geometry,
                                     const VoxelizeOptions& options,
                                     const VoxelizePlan& plan,
                                     Progress& progress,
                                     BlockVisitor* visitor) {
    const std::unique_ptr<PreparedGeometry> prepared = take_prepared(plan, geometry, options.seed);
    const Bins& bins = prepared->bins(progress);
    const VoxelizeContext context(*prepared, options, visitor != nullptr);
    const BlockOrder order(bins.range(), bins.blocks());
    BlockSink sink(context.info(), order.index, plan.spool, options.spool_dir, visitor);
    WorkerPool pool(context);
    progress.begin("voxelize", "primitives", static_cast<std::int64_t>(bins.total_entries()));
    for (const auto [begin, end] : cut_batches(order, bins, plan.batches)) {
        const SortedBlocks sorted(std::span(order.block).subspan(begin, end - begin));
        const Bins::Lists lists = bins.fill(sorted.block, progress);
        parallel_chunks(end - begin, 1, [&, first = begin](std::size_t i, std::size_t) {
            progress.check();
            const std::span<const Primitive> primitives = lists.of(sorted.place[i]);
            VoxelBlock out;
            pool.with([&](BlockWorker& worker) {
                worker.run(order.block[first + i], primitives, progress, out);
            });
            sink.take(first + i, out);
            progress.advance(static_cast<std::int64_t>(primitives.size()));
        });
    }
    return sink.finish();
}

} // namespace heddle
