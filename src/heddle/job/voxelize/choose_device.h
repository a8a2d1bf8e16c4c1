#pragma once

#include <heddle/device/voxelize_device.h>
#include <heddle/job/voxelize/voxelize_options.h>

#include <cstdint>
#include <string>

namespace heddle::job {

/// The processor that voxelizes.
struct ChosenDevice {
    bool cuda = false;
    std::string name{};            ///< of the device
    std::int64_t memory_bytes = 0; ///< memory of the device that may be used
};

/// Chooses the CPU or a CUDA device. It is the CPU for Backend::Raster, and for DeviceChoice::Auto
/// if there is no device or the device does not support the options.
/// @throws Error  for DeviceChoice::Cuda: Device: there is no device; Unsupported: the device does
///                not support the options
[[nodiscard]] ChosenDevice choose_device(const VoxelizeJobOptions& options,
                                         const VoxelizeOptions& asked);

} // namespace heddle::job
