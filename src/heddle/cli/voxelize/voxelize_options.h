#pragma once

#include <heddle/cli/terminal/option.h>
#include <heddle/job/voxelize/voxelize_options.h>

#include <vector>

namespace heddle::cli {

/// The rows that choose a backend and say how slices are drawn: --backend, --composition, ...
[[nodiscard]] std::vector<Option> raster_rows();

/// The rows that say where voxels are made: --device, --device-memory.
[[nodiscard]] std::vector<Option> device_rows();

/// Names in the order of raster::RasterPath.
[[nodiscard]] const std::vector<std::string>& path_names();

/// What the rows of `voxelize` say of curves and meshes.
[[nodiscard]] job::VoxelizeJobOptions voxelize_options_from(const Arguments& arguments);

} // namespace heddle::cli
