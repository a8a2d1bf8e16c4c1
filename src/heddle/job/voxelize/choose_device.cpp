#include <heddle/job/voxelize/choose_device.h>

#include <heddle/base/error.h>
#include <heddle/executor/device.h>

namespace heddle::job {

ChosenDevice choose_device(const VoxelizeJobOptions& options, const VoxelizeOptions& asked) {
    if (options.backend == Backend::Raster || options.device == DeviceChoice::Cpu) return {};
    const executor::Device device = executor::find_device();
    const std::string cannot = device_limitation(asked);
    if (options.device == DeviceChoice::Cuda) {
        if (device.name.empty()) {
            throw Error(ErrorCode::Device, str("`device` cuda: ", device.why),
                        "use `device` cpu, which gives the same voxels");
        }
        if (!cannot.empty()) {
            throw Error(ErrorCode::Unsupported, str("`device` cuda: ", cannot), "use `device` cpu");
        }
    }
    if (device.name.empty() || !cannot.empty()) return {};
    return {.cuda = true,
            .name = device.name,
            .memory_bytes = options.device_memory_bytes.value_or(device.free_bytes / 10 * 9)};
}

} // namespace heddle::job
