#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/job/voxelize/voxelize_options.h>
#include <heddle/viewer/session/job.h>

namespace heddle::viewer {

/// The part that is voxelized, and how; slices are drawn in a context of their own.
struct VoxelRequest {
    Geometry geometry;
    job::VoxelizeJobOptions options;
};

/// Voxelizes it, and builds all levels.
/// @throws Error  as job::voxelize
[[nodiscard]] JobResult voxelize_visible(VoxelRequest request, Progress& progress);

} // namespace heddle::viewer
