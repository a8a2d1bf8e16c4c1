#pragma once

#include <heddle/cli/terminal/option.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/device/voxelize_device.h>

#include <memory>
#include <vector>

namespace heddle::cli {

/// The rows that say where voxels are made: --device, --device-memory.
[[nodiscard]] std::vector<Option> device_options();

/// Where voxels will be made.
struct DeviceChoice {
    bool cuda = false;
    DeviceOptions options; ///< memory_bytes is set where cuda is
};

/// What the rows of device_options() say of this input. `auto` takes the CPU where there is no device or
/// the device does not do what is asked.
/// @throws UsageError  --device-memory without a device
/// @throws Error       Device: --device cuda, and there is none; Unsupported: it does not do this
[[nodiscard]] DeviceChoice
choose_device(const Arguments& arguments, const VoxelizeOptions& options, Report& report);

/// voxelize() where `choice` says, with rows on what the device took.
[[nodiscard]] std::unique_ptr<VoxelSource> voxelize_where(const DeviceChoice& choice,
                                                          const Geometry& geometry,
                                                          const VoxelizeOptions& options,
                                                          const VoxelizePlan& plan,
                                                          Progress& progress,
                                                          LevelBuilder* levels,
                                                          Report& report);

} // namespace heddle::cli
