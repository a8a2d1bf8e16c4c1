#include <heddle/cli/device_options.h>

#include <heddle/base/error.h>
#include <heddle/cli/terminal/text.h>
#include <heddle/executor/device.h>

#include <string>

namespace heddle::cli {

std::vector<Option> device_options() {
    return grouped(
        "Memory and device",
        {
            {"--device", "WHERE", "auto", one_of({"cpu", "cuda", "auto"}), "",
             "Where voxels are computed; the result is the same. auto: CUDA if a GPU is present and supports the options, else the CPU."},
            {"--device-memory", "BYTES", "(9/10 of the free device memory)", bytes(),
             "bytes; suffix K, M, G or T", "Limit of the memory used on the CUDA device."},
        });
}

DeviceChoice
choose_device(const Arguments& arguments, const VoxelizeOptions& options, Report& report) {
    DeviceChoice choice;
    const std::string& where = arguments.text("device");
    const bool memory = arguments.given("device-memory");
    if (where == "cpu") {
        if (memory) throw UsageError("--device-memory cannot be used with --device cpu");
        return choice;
    }
    const executor::Device device = executor::find_device();
    const std::string cannot = why_not_on_device(options);
    if (where == "cuda") {
        if (device.name.empty()) {
            throw Error(ErrorCode::Device, str("--device cuda: ", device.why),
                        "use --device cpu, which gives the same voxels");
        }
        if (!cannot.empty()) {
            throw Error(ErrorCode::Unsupported, str("--device cuda: ", cannot), "use --device cpu");
        }
    }
    choice.cuda = !device.name.empty() && cannot.empty();
    if (!choice.cuda) return choice;
    choice.options.memory_bytes =
        memory ? arguments.bytes("device-memory") : device.free_bytes / 10 * 9;
    report.text("device", device.name);
    return choice;
}

std::unique_ptr<VoxelSource> voxelize_where(const DeviceChoice& choice,
                                            const Geometry& geometry,
                                            const VoxelizeOptions& options,
                                            const VoxelizePlan& plan,
                                            Progress& progress,
                                            LevelBuilder* levels,
                                            Report& report) {
    if (!choice.cuda) return voxelize(geometry, options, plan, progress, levels);
    DeviceReport took;
    DeviceOptions device = choice.options;
    device.report = &took;
    std::unique_ptr<VoxelSource> made =
        voxelize_on_cuda(geometry, options, plan, device, progress, levels);
    report.bytes("peak device memory", took.peak_bytes);
    report.count("device batches", took.batches);
    report.seconds("upload", took.upload_seconds);
    return made;
}

} // namespace heddle::cli
