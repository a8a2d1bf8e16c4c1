#include <heddle/voxelize/voxelize.h>

#include <heddle/base/parallel.h>
#include <heddle/voxel/block_keeper.h>
#include <heddle/voxelize/block_order.h>
#include <heddle/voxelize/block_worker.h>

#include <algorithm>
#include <numeric>

namespace heddle {
namespace {

/// The numbers of some blocks ascending, as Bins::fill wants them, and where each went.
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

} // namespace

std::unique_ptr<VoxelSource> voxelize(const Geometry& geometry,
                                      const VoxelizeOptions& options,
                                      const VoxelizePlan& plan,
                                      Progress& progress,
                                      BlockVisitor* visitor) {
    VoxelizeContext context(geometry, options, plan.lattice, plan.voxel_lo, plan.voxel_hi);
    const Bins bins(context.fibers, context.triangles, context.range, progress);
    const BlockOrder order(bins.range(), bins.blocks());
    const std::span<const std::uint32_t> blocks(order.block);
    BlockKeeper keeper(context.info(), blocks.size(), plan.spool, options.spool_dir);
    if (visitor != nullptr) {
        context.fit.fields.masks = true;
        visitor->begin(context.info(), order.index, plan.spool ? options.spool_dir : "");
    }
    WorkerPool pool(context);
    progress.begin("voxelize", "primitives", static_cast<std::int64_t>(bins.total_entries()));
    const std::uint64_t batch_entries =
        bins.total_entries() / static_cast<std::uint64_t>(std::max<std::int64_t>(1, plan.batches)) +
        1;
    for (std::size_t begin = 0; begin < blocks.size();) {
        std::size_t end = begin;
        for (std::uint64_t sum = 0; end < blocks.size() && sum < batch_entries; ++end) {
            sum += bins.entries(blocks[end]);
        }
        const SortedBlocks sorted(blocks.subspan(begin, end - begin));
        const Bins::Lists lists = bins.fill(sorted.block, progress);
        parallel_chunks(end - begin, 1, [&](std::size_t i, std::size_t) {
            progress.check();
            const std::span<const Primitive> primitives = lists.of(sorted.place[i]);
            VoxelBlock out;
            pool.with([&](BlockWorker& worker) {
                worker.run(blocks[begin + i], primitives, progress, out);
            });
            if (visitor != nullptr) visitor->visit(begin + i, out);
            if (!options.keep_sums) drop_sums(out);
            keeper.keep(begin + i, out);
            progress.advance(static_cast<std::int64_t>(primitives.size()));
        });
        begin = end;
    }
    return keeper.finish();
}

} // namespace heddle
