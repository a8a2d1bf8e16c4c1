// The pipeline of the device on cloth as of [Fabre26, table 3], in seconds: heddle_device_speed [ROWS]
// ROWS: how many of the nine, the fastest first; default all. Without a device: one small row by the
// host executor, to see that the program runs.

#include "cases.h"
#include "copy_bandwidth.h"

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/device/voxelize_device.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

namespace heddle::check {
namespace {

/// A row of the paper's table: seconds on a GTX 1080 Ti, voxels alone and with levels.
struct Row {
    const char* shape;
    double nodes; ///< of fibers, each of 60 samples
    int voxels;
    double paper, paper_levels;
};
constexpr Row kRows[] = {
    {"flat", 8.36e6, 1024, 3.45, 8.8},    {"flat", 8.36e6, 2048, 6.06, 9.2},
    {"flat", 8.36e6, 4096, 22.3, 9.4},    {"folded", 8.36e6, 1024, 3.52, 8.0},
    {"folded", 8.36e6, 2048, 6.16, 8.2},  {"folded", 8.36e6, 4096, 21.2, 58.2},
    {"hanging", 163e6, 1024, 20.5, 58.2}, {"hanging", 163e6, 2048, 22.3, 66.1},
    {"hanging", 163e6, 4096, 36.1, 48.6},
};
constexpr int kFibers = 150;

double seconds_of(const auto& body) {
    const auto start = std::chrono::steady_clock::now();
    body();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// One voxelization's time and what it made.
struct Run {
    double seconds = 0.0;
    std::int64_t voxels = 0;
    double gigabytes = 0.0; ///< of all that is stored
    DeviceReport report;
};

Run run_device(const Geometry& g,
               const VoxelizeOptions& options,
               DeviceOptions device,
               bool levels) {
    Run out;
    const VoxelizePlan plan = plan_range(g, options);
    const bool cuda = !gpu::find_device().name.empty();
    VoxelLevels made;
    out.seconds = seconds_of([&] {
        LevelBuilder builder({});
        Progress silent;
        auto level0 = (cuda ? voxelize_on_cuda : voxelize_on_host_executor)(
            g, options, plan, device, silent, levels ? &builder : nullptr, &out.report);
        if (levels) {
            made = builder.finish(std::move(level0));
        } else {
            made.push_back(std::move(level0));
        }
    });
    out.voxels = made[0]->info().voxel_count;
    for (const auto& level : made) {
        VoxelBlock scratch;
        for (std::size_t b = 0; b < level->block_count(); ++b) {
            out.gigabytes += 1e-9 * static_cast<double>(level->block(b, scratch).byte_count());
        }
    }
    return out;
}

double cpu_seconds(const Geometry& g, const VoxelizeOptions& options) {
    const VoxelizePlan plan = plan_range(g, options);
    return seconds_of([&] {
        Progress silent;
        static_cast<void>(voxelize(g, options, plan, silent));
    });
}

void print_row(const Row& row, bool with_cpu) {
    const Geometry g = cloth(row.shape, row.nodes, kFibers);
    VoxelizeOptions options;
    options.voxels = row.voxels;
    std::size_t points = 0;
    for (const CurveSet& set : g.curves) points += set.points.size();
    const Run first = run_device(g, options, {}, false); // the pool of memory fills
    const Run level0 = run_device(g, options, {}, false);
    const Run levels = run_device(g, options, {}, true);
    const Run timed = run_device(g, options, {.time_stages = true}, true);
    std::printf("| %s, %.3g M nodes, %d | %.1f M | %.3f (first %.3f) | %.1f x | %.3f | %.1f x | ",
                row.shape, 1e-6 * static_cast<double>(points) * kFibers, row.voxels,
                1e-6 * static_cast<double>(level0.voxels), level0.seconds, first.seconds,
                row.paper / level0.seconds, levels.seconds, row.paper_levels / levels.seconds);
    if (with_cpu) {
        std::printf("%.2f |", cpu_seconds(g, options));
    } else {
        std::printf("- |");
    }
    for (const auto& [stage, seconds] : timed.report.stages) {
        std::printf(" %s %.1f ms,", stage.c_str(), 1e3 * seconds);
    }
    std::printf(" %lld batches, %.2f GB device memory |\n",
                static_cast<long long>(levels.report.batches),
                1e-9 * static_cast<double>(levels.report.peak_bytes));
    std::fflush(stdout);
}

int main_of(int rows) {
    const gpu::Device device = gpu::find_device();
    std::printf("device: %s\nthreads of the host: %d\n",
                device.name.empty() ? device.why.c_str() : device.name.c_str(), thread_count());
    std::printf("copy bandwidth of the device: %.0f GB/s\n\n", copy_bandwidth());
    std::printf("| cloth, nodes of fibers, voxels along the longest axis | voxels | level 0, s | "
                "the paper's time / this | with levels, s | the paper's / this | all cores of the "
                "CPU, level 0, s | launches |\n|---|---|---|---|---|---|---|---|\n");
    if (device.name.empty()) {
        print_row({"flat", 1e5, 128, 0.0, 0.0}, true);
        return 0;
    }
    for (int r = 0; r < rows; ++r) print_row(kRows[r], r % 3 == 0 && r < 6);
    return 0;
}

} // namespace
} // namespace heddle::check

int main(int argc, char** argv) {
    try {
        const int rows = argc > 1 ? std::atoi(argv[1]) : 9;
        return heddle::check::main_of(rows < 0 ? 0 : rows > 9 ? 9 : rows);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "speed: %s\n", e.what());
        return 1;
    }
}
