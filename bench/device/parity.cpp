// Compares the bits of voxels and levels of the CPU, of the device pipeline on the host's threads
// and, if there is one, on the device.   heddle_device_parity [--small] Exits with 1 if they
// differ.

#include "cases.h"
#include "level_bits.h"

#include <heddle/base/error.h>
#include <heddle/device/voxelize_device.h>

#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <exception>

namespace heddle::check {
namespace {

template <typename Voxelize>
std::uint64_t run(const Case& c, const Voxelize& voxelize_it) {
    LevelBuilder levels({});
    Progress silent;
    const VoxelizePlan plan = plan_voxelize(c.geometry, c.options, silent, &levels);
    auto level0 = voxelize_it(plan, silent, &levels);
    return bits_of(levels.finish(std::move(level0)));
}

bool check(const Case& c, bool with_device) {
    DeviceOptions device;
    device.batches = c.batches;
    const std::uint64_t cpu =
        run(c, [&](const VoxelizePlan& plan, Progress& progress, LevelBuilder* levels) {
            return voxelize(c.geometry, c.options, plan, progress, levels);
        });
    const std::uint64_t host =
        run(c, [&](const VoxelizePlan& plan, Progress& progress, LevelBuilder* levels) {
            return voxelize_on_host_executor(c.geometry, c.options, plan, device, progress, levels);
        });
    std::printf("| %s | %016" PRIx64 " | %s |", c.name.c_str(), cpu,
                host == cpu ? "same" : "DIFFERS");
    bool same = host == cpu;
    if (with_device) {
        const std::uint64_t cuda =
            run(c, [&](const VoxelizePlan& plan, Progress& progress, LevelBuilder* levels) {
                return voxelize_on_cuda(c.geometry, c.options, plan, device, progress, levels);
            });
        std::printf(" %s |\n", cuda == cpu ? "same" : "DIFFERS");
        same = same && cuda == cpu;
    } else {
        std::printf(" no device |\n");
    }
    return same;
}

int main_of(bool small) {
    const executor::Device device = executor::find_device();
    std::printf("device: %s\n\n", device.name.empty() ? device.why.c_str() : device.name.c_str());
    std::printf("| case | bits by the CPU | host executor | CUDA |\n|---|---|---|---|\n");
    bool same = true;
    for (const Case& c : small ? small_cases() : parity_cases()) {
        same = check(c, !device.name.empty()) && same;
        std::fflush(stdout);
    }
    return same ? 0 : 1;
}

} // namespace
} // namespace heddle::check

int main(int argc, char** argv) {
    try {
        return heddle::check::main_of(argc > 1 && std::strcmp(argv[1], "--small") == 0);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "parity: %s\n", e.what());
        return 1;
    }
}
