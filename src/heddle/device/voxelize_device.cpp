#include <heddle/device/voxelize_device.h>

#include <heddle/base/memory.h>
#include <heddle/device/device_run.h>
#include <heddle/executor/host_executor.h>

namespace heddle {

std::string device_limitation(const VoxelizeOptions& options) {
    if (options.coverage == CoverageMode::Mask) return "coverage 'mask' is made on the CPU alone";
    if (options.fit == FitMode::Last) return "fit 'last' is made on the CPU alone";
    return {};
}

std::array<bool, kPrimitiveKinds> kinds_of(const VoxelizeContext& context) {
    std::array<bool, kPrimitiveKinds> there{};
    const FiberView fibers = context.prepared.fibers.view();
    for (std::size_t s = 0; s < fibers.set_count; ++s) {
        there[number_of(kind_of(fibers.sets[s]))] = true;
    }
    const SurfaceView surfaces = context.prepared.surfaces.view();
    for (std::size_t m = 0; m < surfaces.mesh_count; ++m) {
        there[number_of(surfaces.meshes[m].kind)] = true;
    }
    return there;
}

void check_device_options(const VoxelizeOptions& options, const DeviceOptions& device) {
    const std::string cannot = device_limitation(options);
    if (!cannot.empty()) {
        throw Error(ErrorCode::Unsupported, "voxelize: " + cannot, "use the CPU");
    }
    if (device.memory_bytes < 0 || device.streams < 1 || device.batches < 0) {
        throw Error(ErrorCode::InvalidArgument,
                    str("voxelize: ", device.memory_bytes, " bytes of device memory, ",
                        device.streams, " streams, ", device.batches, " batches"),
                    "use at least one stream");
    }
}

std::unique_ptr<VoxelLevel> voxelize_on_host_executor(const Geometry& geometry,
                                                      const VoxelizeOptions& options,
                                                      const VoxelizePlan& plan,
                                                      const DeviceOptions& device,
                                                      Progress& progress,
                                                      LevelBuilder* levels) {
    check_device_options(options, device);
    DeviceOptions with_memory = device;
    if (device.memory_bytes == 0) with_memory.memory_bytes = available_bytes() / 10 * 9;
    return run_on<executor::HostExecutor>(geometry, options, plan, with_memory, progress, levels);
}

#if !HEDDLE_HAS_CUDA

std::unique_ptr<VoxelLevel> voxelize_on_cuda(const Geometry&,
                                             const VoxelizeOptions&,
                                             const VoxelizePlan&,
                                             const DeviceOptions&,
                                             Progress&,
                                             LevelBuilder*) {
    throw Error(ErrorCode::Device, "voxelize: " + executor::find_device().why, "use the CPU");
}

#endif

} // namespace heddle
