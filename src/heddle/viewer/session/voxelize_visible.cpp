#include <heddle/viewer/session/voxelize_visible.h>

#include <heddle/base/error.h>
#include <heddle/job/voxelize/voxelize.h>

#include <memory>
#include <utility>

namespace heddle::viewer {

JobResult voxelize_visible(VoxelRequest request, Progress& progress) {
    job::VoxelizeResult result =
        job::voxelize({.geometry = std::move(request.geometry)}, request.options, progress);
    const std::int64_t voxels = result.report.counts.voxels;
    auto levels = std::make_shared<VoxelLevels>(std::move(result.levels));
    return {str(voxels, " voxels in ", levels->size(), " levels"), std::move(levels)};
}

} // namespace heddle::viewer
