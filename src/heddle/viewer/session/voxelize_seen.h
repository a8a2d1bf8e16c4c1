#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/raster/voxelize_slices.h>
#include <heddle/viewer/session/job.h>
#include <heddle/voxelize/voxelize.h>

namespace heddle::viewer {

/// What is to be voxelized, and how.
struct VoxelRequest {
    Geometry geometry;
    VoxelizeOptions options;
    bool raster = false; ///< slices drawn by OpenGL, in a context of its own; else fibers
    raster::RasterOptions raster_options;
};

/// Voxels with all their levels.
/// @throws Error  as plan_voxelize, voxelize and raster::voxelize_slices
[[nodiscard]] JobResult voxelize_seen(const VoxelRequest& request, Progress& progress);

} // namespace heddle::viewer
