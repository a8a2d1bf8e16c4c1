#include <heddle/viewer/session/voxelize_seen.h>

#include <heddle/base/error.h>
#include <heddle/lod/build_levels.h>

#include <utility>

namespace heddle::viewer {

JobResult voxelize_seen(const VoxelRequest& request, Progress& progress) {
    LevelBuilder builder({});
    const VoxelizePlan plan = plan_voxelize(request.geometry, request.options, progress, &builder);
    std::unique_ptr<VoxelSource> finest =
        request.raster ? raster::voxelize_slices(request.geometry, request.options,
                                                 request.raster_options, plan, progress, &builder)
                       : voxelize(request.geometry, request.options, plan, progress, &builder);
    auto levels = std::make_shared<VoxelLevels>(builder.finish(std::move(finest)));
    const std::int64_t voxels = levels->front()->info().voxel_count;
    return {str(voxels, " voxels in ", levels->size(), " levels"), std::move(levels)};
}

} // namespace heddle::viewer
