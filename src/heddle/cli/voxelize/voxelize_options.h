#pragma once

#include <heddle/cli/terminal/option.h>
#include <heddle/job/voxelize/voxelize_options.h>

#include <vector>

namespace heddle::cli {

/// Returns the rows for the backend that draws slices: --backend, --composition and so on.
[[nodiscard]] std::vector<Option> raster_rows();

/// Returns the rows for the processor that voxelizes: --device, --device-memory.
[[nodiscard]] std::vector<Option> device_rows();

/// Returns the names of paths in the order of raster::RasterPath.
[[nodiscard]] const std::vector<std::string>& path_names();

/// Returns the options of `voxelize` for curves and meshes.
[[nodiscard]] job::VoxelizeJobOptions voxelize_options_from(const Arguments& arguments);

} // namespace heddle::cli
