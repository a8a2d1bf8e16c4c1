#pragma once

#include <heddle/base/progress.h>
#include <heddle/cli/terminal/option.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/geom/geometry.h>
#include <heddle/raster/voxelize_slices.h>
#include <heddle/voxelize/voxelize.h>

#include <memory>
#include <vector>

namespace heddle::cli {

/// The rows that choose a backend and say how slices are drawn: --backend, --composition, ...
[[nodiscard]] std::vector<Option> raster_options();

/// True where slices are to be drawn by OpenGL.
[[nodiscard]] bool uses_raster(const Arguments& arguments);

/// Makes slices of procedural yarns where they are to be drawn, and notes what that leaves out.
/// @throws UsageError  rows that the backend has no use for
void prepare_backend(Geometry& geometry, const Arguments& arguments);

/// What those rows say of how slices are drawn.
[[nodiscard]] raster::RasterOptions raster_options_from(const Arguments& arguments);

/// Voxelizes by OpenGL, and reports what was drawn.
/// @throws Error  as SliceVoxelizer
[[nodiscard]] std::unique_ptr<VoxelSource> voxelize_raster(const Geometry& geometry,
                                                           const VoxelizeOptions& options,
                                                           const VoxelizePlan& plan,
                                                           raster::SliceVoxelizer& drawer,
                                                           Progress& progress,
                                                           BlockVisitor* visitor,
                                                           Report& report);

} // namespace heddle::cli
