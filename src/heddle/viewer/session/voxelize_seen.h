#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/raster/voxelize_slices.h>
#include <heddle/viewer/session/job.h>
#include <heddle/voxelize/voxelize.h>

namespace heddle::viewer {

/// The part that is voxelized, and how.
struct VoxelRequest {
    Geometry geometry;
    VoxelizeOptions options;
    bool raster = false; ///< from slices drawn by OpenGL, in a context of its own; else from fibers
    raster::RasterOptions raster_options;
};

/// Voxelizes it, and builds all levels.
/// @throws Error  as plan_voxelize, voxelize and raster::voxelize_slices
[[nodiscard]] JobResult voxelize_seen(const VoxelRequest& request, Progress& progress);

} // namespace heddle::viewer
