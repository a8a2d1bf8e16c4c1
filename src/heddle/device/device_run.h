#pragma once

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/device/batch_plan.h>
#include <heddle/device/deliver_blocks.h>
#include <heddle/device/gather_batch.h>
#include <heddle/device/upload_fibers.h>
#include <heddle/device/upload_surfaces.h>
#include <heddle/device/voxelize_device.h>
#include <heddle/voxel/block_sink.h>
#include <heddle/voxelize/block_worker.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <utility>
#include <vector>

namespace heddle {

/// @throws Error  Unsupported: device_limitation(); InvalidArgument: options that cannot be
void check_device_options(const VoxelizeOptions& options, const DeviceOptions& device);

/// Returns for each kind whether there are primitives of it.
[[nodiscard]] std::array<bool, kPrimitiveKinds> kinds_of(const VoxelizeContext& context);

/// One voxelization by executors of one kind. The geometry is uploaded once; then batches of blocks
/// are gathered, fitted and downloaded, each by the next stream that is free.
template <typename Exec>
class DeviceRun {
public:
    using MakeExec = std::function<std::unique_ptr<Exec>(executor::Budget&)>;

    /// @param device  memory_bytes is set
    DeviceRun(const VoxelizeContext& context,
              const VoxelizePlan& plan,
              const DeviceOptions& device,
              MakeExec make)
        : context_(context),
          plan_(plan),
          device_(device),
          make_(std::move(make)),
          budget_(device.memory_bytes) {}

    [[nodiscard]] std::unique_ptr<VoxelLevel> run(Progress& progress, LevelBuilder* levels);

private:
    /// The data of one stream.
    struct Lane {
        std::unique_ptr<Exec> exec;
        executor::Array<std::uint32_t> slot_of_block;
        BatchLevels built;
    };

    [[nodiscard]] std::unique_ptr<Exec> make_executor();
    void upload();
    void count();
    [[nodiscard]] std::vector<BatchRange> plan_work() const;
    void work(std::size_t streams, const std::vector<BatchRange>& batches, Progress& progress);
    void run_batch(Lane& lane, BatchRange range, Progress& progress);
    void finish_batch(Lane& lane, BatchRange range, const BlockBatch& batch, LevelArrays& level0);
    [[nodiscard]] BlockBatch batch_of(BatchRange range) const;

    const VoxelizeContext& context_;
    const VoxelizePlan& plan_;
    DeviceOptions device_;
    MakeExec make_;
    executor::Budget budget_;
    executor::PhaseTimes times_;
    std::unique_ptr<Exec> base_; ///< owns the data that all streams read
    DeviceGeometry scene_;
    DeviceFibers fibers_;
    DeviceFiberTables tables_;
    DeviceSurfaces surfaces_;
    PairCounts counts_;
    std::unique_ptr<BlockOrder> order_;
    std::unique_ptr<BlockSink> sink_;
    LevelBuilder* levels_ = nullptr;
    std::atomic<std::int64_t> batches_{0};
};

template <typename Exec>
std::unique_ptr<Exec> DeviceRun<Exec>::make_executor() {
    std::unique_ptr<Exec> exec = make_(budget_);
    if (device_.time_phases) exec->time_phases(&times_);
    return exec;
}

template <typename Exec>
void DeviceRun<Exec>::upload() {
    Exec& exec = *base_;
    exec.set_phase("upload");
    const PreparedGeometry& prepared = context_.prepared;
    const HostFiberTables placed = place_all_fibers(prepared.fibers);
    fibers_ = upload_fibers(exec, prepared.fibers);
    tables_ = upload_tables(exec, placed);
    surfaces_ = upload_surfaces(exec, prepared.surfaces);
    exec.wait();
    scene_.surfaces = surfaces_.view;
    scene_.fibers = fibers_.view;
    scene_.tables = view_of(tables_);
    scene_.units = prepared.units;
    scene_.range = prepared.range;
    scene_.fit = context_.fit;
}

template <typename Exec>
void DeviceRun<Exec>::count() {
    Exec& exec = *base_;
    exec.set_phase("bin");
    const std::size_t blocks = context_.prepared.range.count();
    std::array<executor::Array<std::uint32_t>, kPrimitiveKinds> counts;
    CountPairs to{};
    const std::array<bool, kPrimitiveKinds> there = kinds_of(context_);
    for (std::size_t k = 0; k < kPrimitiveKinds; ++k) {
        if (!there[k]) continue;
        counts[k] = exec.template make_zero<std::uint32_t>(blocks);
        to.counts[k] = counts[k].data();
    }
    walk_primitives(exec, scene_, to);
    for (std::size_t k = 0; k < kPrimitiveKinds; ++k) {
        counts_[k].resize(counts[k].size());
        exec.download(std::span(counts_[k]), counts[k].data());
    }
}

template <typename Exec>
std::vector<BatchRange> DeviceRun<Exec>::plan_work() const {
    const auto streams = static_cast<std::int64_t>(device_.streams);
    const auto slots =
        static_cast<std::int64_t>(context_.prepared.range.count() * sizeof(std::uint32_t));
    const BatchNeeds needs{static_cast<std::int64_t>(context_.prepared.geometry.materials.size()),
                           batch_options(context_.fit, levels_)};
    const std::int64_t room = budget_.limit() - budget_.used() - streams * slots;
    return plan_batches(*order_, counts_, needs, room / streams,
                        std::max(device_.batches, streams));
}

template <typename Exec>
BlockBatch DeviceRun<Exec>::batch_of(BatchRange range) const {
    BlockBatch batch;
    for (auto& first : batch.first_pair) first.push_back(0);
    for (std::size_t i = range.begin; i < range.end; ++i) {
        const std::uint32_t number = order_->block[i];
        BatchBlock& block = batch.blocks.emplace_back();
        Vec3i end;
        context_.prepared.range.voxels(number, block.lo, end);
        block.index = order_->index[i];
        block.size = end - block.lo;
        batch.numbers.push_back(number);
        for (std::size_t k = 0; k < kPrimitiveKinds; ++k) {
            const std::uint32_t pairs = counts_[k].empty() ? 0 : counts_[k][number];
            batch.first_pair[k].push_back(batch.first_pair[k].back() + pairs);
        }
    }
    return batch;
}

template <typename Exec>
void DeviceRun<Exec>::work(std::size_t streams,
                           const std::vector<BatchRange>& batches,
                           Progress& progress) {
    std::atomic<std::size_t> next{0};
    const auto run_lane = [&] {
        Lane lane;
        lane.exec = make_executor();
        lane.exec->set_phase("bin");
        lane.slot_of_block =
            lane.exec->template make<std::uint32_t>(context_.prepared.range.count());
        for (std::size_t b = next++; b < batches.size(); b = next++) {
            run_batch(lane, batches[b], progress);
        }
    };
    std::vector<std::future<void>> lanes;
    for (std::size_t s = 0; s < streams; ++s) {
        lanes.push_back(std::async(std::launch::async, [&] {
            try {
                run_lane();
            } catch (...) {
                next = batches.size(); // stops the other streams too
                throw;
            }
        }));
    }
    for (std::future<void>& lane : lanes) lane.wait(); // the data must outlive the threads
    for (std::future<void>& lane : lanes) lane.get();
}

/// Processes a batch; if it does not fit in memory, processes its halves.
template <typename Exec>
void DeviceRun<Exec>::run_batch(Lane& lane, BatchRange range, Progress& progress) {
    progress.check();
    BlockBatch batch = batch_of(range);
    std::int64_t pairs = 0;
    for (const auto& first : batch.first_pair) pairs += static_cast<std::int64_t>(first.back());
    try {
        LevelArrays level0 = gather_batch(*lane.exec, scene_, batch, lane.slot_of_block.data());
        finish_batch(lane, range, batch, level0);
    } catch (const Error& e) {
        if (e.code() != ErrorCode::OutOfMemory || range.end - range.begin < 2) throw;
        const std::size_t middle = range.begin + (range.end - range.begin) / 2;
        run_batch(lane, {range.begin, middle}, progress);
        run_batch(lane, {middle, range.end}, progress);
        return;
    }
    ++batches_;
    progress.advance(pairs);
}

template <typename Exec>
void DeviceRun<Exec>::finish_batch(Lane& lane,
                                   BatchRange range,
                                   const BlockBatch& batch,
                                   LevelArrays& level0) {
    build_batch_levels(*lane.exec, std::move(level0), batch.blocks.size(),
                       batch_options(context_.fit, levels_), lane.built);
    deliver_blocks(lane.built, range.begin, batch.blocks, *sink_, levels_);
}

template <typename Exec>
std::unique_ptr<VoxelLevel> DeviceRun<Exec>::run(Progress& progress, LevelBuilder* levels) {
    DeviceReport report;
    const auto seconds_since = [](std::chrono::steady_clock::time_point start) {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    levels_ = levels;
    auto start = std::chrono::steady_clock::now();
    base_ = make_executor();
    upload();
    report.upload_seconds = seconds_since(start);
    start = std::chrono::steady_clock::now();
    count();
    report.count_seconds = seconds_since(start);
    start = std::chrono::steady_clock::now();
    order_ = std::make_unique<BlockOrder>(context_.prepared.range, occupied_blocks(counts_));
    sink_ = std::make_unique<BlockSink>(context_.info(), order_->index, plan_.spool,
                                        context_.options.spool_dir, levels);
    std::int64_t pairs = 0;
    for (const auto& of : counts_) {
        for (const std::uint32_t n : of) pairs += n;
    }
    progress.begin("voxelize", "primitives", pairs);
    work(static_cast<std::size_t>(device_.streams), plan_work(), progress);
    report.batch_seconds = seconds_since(start);
    report.batches = batches_;
    report.peak_bytes = budget_.peak();
    report.stages = times_.all();
    if (device_.report != nullptr) *device_.report = report;
    return sink_->finish();
}

/// Voxelizes by executors of a kind that is constructed from a Budget.
/// @param device  memory_bytes is set
template <typename Exec>
[[nodiscard]] std::unique_ptr<VoxelLevel> run_on(const Geometry& geometry,
                                                 const VoxelizeOptions& options,
                                                 const VoxelizePlan& plan,
                                                 const DeviceOptions& device,
                                                 Progress& progress,
                                                 LevelBuilder* levels) {
    const std::unique_ptr<PreparedGeometry> prepared = take_prepared(plan, geometry, options.seed);
    prepared->drop_bins(); // the device counts by kind
    const VoxelizeContext context(*prepared, options);
    DeviceRun<Exec> run(context, plan, device,
                        [](executor::Budget& budget) { return std::make_unique<Exec>(budget); });
    return run.run(progress, levels);
}

} // namespace heddle
