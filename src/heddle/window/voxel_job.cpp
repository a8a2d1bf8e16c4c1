#include <heddle/window/voxel_job.h>

#include <heddle/base/error.h>
#include <heddle/lod/build_levels.h>

#include <utility>

namespace heddle::window {

VoxelJob::VoxelJob(VoxelRequest request)
    : thread_([this, taken = std::move(request)]() mutable { run(std::move(taken)); }) {}

VoxelJob::~VoxelJob() {
    cancel();
    if (thread_.joinable()) thread_.join();
}

std::string VoxelJob::stage() const {
    const std::lock_guard lock(naming_);
    return stage_;
}

double VoxelJob::part() const {
    const std::int64_t total = total_;
    return total > 0 ? static_cast<double>(done_) / static_cast<double>(total) : 0.0;
}

std::optional<VoxelResult> VoxelJob::poll() {
    if (!finished_ || !thread_.joinable()) return std::nullopt;
    thread_.join();
    return std::move(result_);
}

void VoxelJob::begin(std::string_view stage, std::string_view, std::int64_t total) {
    const std::lock_guard lock(naming_);
    stage_ = stage;
    done_ = 0;
    total_ = total;
}

void VoxelJob::run(VoxelRequest request) {
    try {
        LevelBuilder builder({});
        const VoxelizePlan plan = plan_voxelize(request.geometry, request.options, *this, &builder);
        std::unique_ptr<VoxelSource> finest =
            request.raster ? raster::voxelize_slices(request.geometry, request.options,
                                                     request.raster_options, plan, *this, &builder)
                           : voxelize(request.geometry, request.options, plan, *this, &builder);
        auto levels = std::make_shared<VoxelLevels>(builder.finish(std::move(finest)));
        const std::int64_t voxels = levels->front()->info().voxel_count;
        result_ = {levels, str(voxels, " voxels in ", levels->size(), " levels")};
    } catch (const Error& e) {
        result_ = {nullptr, e.what()};
    } catch (const std::exception& e) {
        result_ = {nullptr, str("voxelize: ", e.what())};
    }
    finished_ = true;
}

} // namespace heddle::window
