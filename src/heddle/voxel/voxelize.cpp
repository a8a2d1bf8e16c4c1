#include <heddle/voxel/voxelize.h>

#include <heddle/base/parallel.h>
#include <heddle/voxel/block_worker.h>
#include <heddle/voxel/spool.h>

#include <algorithm>
#include <mutex>

namespace heddle {
namespace {

VoxelGridInfo info_of(const VoxelizeContext& context, const VoxelizePlan& plan) {
    VoxelGridInfo info{.name = context.geometry.name,
                       .lattice = plan.lattice,
                       .max_lobes = context.options.max_lobes,
                       .fields = context.fit.fields,
                       .materials = context.geometry.materials,
                       .yarns = context.geometry.yarns,
                       .command = context.options.command};
    for (YarnType& yarn : info.yarns) yarn.slice.texels.clear();
    return info;
}

/// Where finished blocks go: memory, or a file.
class Keeper {
public:
    Keeper(VoxelGridInfo info, std::size_t blocks, bool spool, const std::string& folder) {
        if (spool) {
            spooled_ = std::make_unique<SpooledGrid>(folder);
            spooled_->about = std::move(info);
            spooled_->resize(blocks);
        } else {
            grid_ = std::make_unique<VoxelGrid>();
            grid_->about = std::move(info);
            grid_->blocks.resize(blocks);
        }
    }

    void keep(std::size_t i, VoxelBlock& block, const BlockCounts& counts) {
        const std::scoped_lock lock(mutex_);
        voxels_ += counts.voxels;
        lobes_ += counts.lobes;
        if (spooled_) {
            spooled_->store(i, block);
        } else {
            grid_->blocks[i] = std::move(block);
        }
    }

    std::unique_ptr<VoxelSource> finish() {
        VoxelGridInfo& info = spooled_ ? spooled_->about : grid_->about;
        info.voxel_count = voxels_;
        info.lobe_count = lobes_;
        if (spooled_) return std::move(spooled_);
        return std::move(grid_);
    }

private:
    std::mutex mutex_;
    std::unique_ptr<VoxelGrid> grid_;
    std::unique_ptr<SpooledGrid> spooled_;
    std::int64_t voxels_ = 0;
    std::int64_t lobes_ = 0;
};

} // namespace

std::unique_ptr<VoxelSource> voxelize(const Geometry& geometry,
                                      const VoxelizeOptions& options,
                                      const VoxelizePlan& plan,
                                      Progress& progress) {
    const VoxelizeContext context(geometry, options, plan.lattice, plan.voxel_lo, plan.voxel_hi);
    const Bins bins(context.fibers, context.triangles, context.range, progress);
    const std::span<const std::uint32_t> blocks(bins.blocks());
    Keeper keeper(info_of(context, plan), blocks.size(), plan.spool, options.spool_dir);
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
        const Bins::Lists lists = bins.fill(blocks.subspan(begin, end - begin), progress);
        parallel_chunks(end - begin, 1, [&](std::size_t i, std::size_t) {
            progress.check();
            pool.with([&](BlockWorker& worker) {
                VoxelBlock out;
                const BlockCounts counts =
                    worker.run(blocks[begin + i], lists.of(i), progress, out);
                out.shrink_to_fit();
                keeper.keep(begin + i, out, counts);
            });
            progress.advance(static_cast<std::int64_t>(lists.of(i).size()));
        });
        begin = end;
    }
    return keeper.finish();
}

} // namespace heddle
