#include <heddle/device/voxelize_device.h>

#include <heddle/device/device_run.h>
#include <heddle/executor/cuda_executor.cuh>

namespace heddle {

std::unique_ptr<VoxelLevel> voxelize_on_cuda(const Geometry& geometry,
                                             const VoxelizeOptions& options,
                                             const VoxelizePlan& plan,
                                             const DeviceOptions& device,
                                             Progress& progress,
                                             LevelBuilder* levels) {
    check_device_options(options, device);
    const executor::Device found = executor::find_device();
    if (found.name.empty()) throw Error(ErrorCode::Device, "voxelize: " + found.why, "use the CPU");
    DeviceOptions with_memory = device;
    if (device.memory_bytes == 0) with_memory.memory_bytes = found.free_bytes / 10 * 9;
    return run_on<executor::CudaExecutor>(geometry, options, plan, with_memory, progress, levels);
}

} // namespace heddle
