#pragma once

#include <heddle/device/voxelize_device.h>
#include <heddle/job/voxelize/voxelize_options.h>

#include <cstdint>
#include <string>

namespace heddle::job {

/// Where voxels will be made.
struct ChosenDevice {
    bool cuda = false;
    std::string name{};            ///< of the device
    std::int64_t memory_bytes = 0; ///< of the device that may be used
};

/// DeviceChoice::Auto takes the CPU where there is no device or it does not do what is asked, and
/// so does Backend::Raster.
/// @throws Error  Device: DeviceChoice::Cuda, and there is none; Unsupported: it does not do this
[[nodiscard]] ChosenDevice choose_device(const VoxelizeJobOptions& options,
                                         const VoxelizeOptions& asked);

} // namespace heddle::job
