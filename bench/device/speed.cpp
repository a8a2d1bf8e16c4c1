// Seconds of the device pipeline on cloth as in [Fabre26, table 3]: heddle_device_speed [ROWS]
// ROWS: how many of the nine rows, the fastest first; default all. Without a device: one small row
// with the host executor, to check that the program runs.

#include "cases.h"
#include "device_peaks.h"

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/device/voxelize_device.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace heddle::check {
namespace {

/// A row of the paper's table: seconds on a GTX 1080 Ti, for voxels alone and with levels.
struct Row {
    const char* shape;
    double nodes; ///< of fibers, each with 60 samples
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

/// The other way to read the paper: its nodes are nodes of yarns, each of which has 150 fibers.
constexpr Row kOtherReading{"flat", 150 * 8.36e6, 1024, 3.45, 8.8};

/// Minimum operations of a sample, counted in expand_op.h: the fiber's point and its chord.
constexpr double kFlopsPerSample = 80.0;
constexpr double kSamplesPerNode = 60.0;

/// The best that the device can do.
struct Peaks {
    double gigabytes = copy_bandwidth();
    double gigaflops = peak_gigaflops();
};

double seconds_of(const auto& body) {
    const auto start = std::chrono::steady_clock::now();
    body();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The time of one voxelization and its result.
struct Run {
    double seconds = 0.0;
    VoxelLevels levels;
    DeviceReport report;

    /// Seconds of launches in phases whose names begin with `begin`.
    [[nodiscard]] double launches(const std::string& begin = "") const {
        double sum = 0.0;
        for (const auto& [stage, spent] : report.stages) {
            if (stage.starts_with(begin)) sum += spent;
        }
        return sum;
    }
};

Run run_device(const Geometry& g,
               const VoxelizeOptions& options,
               DeviceOptions device,
               bool levels) {
    Run out;
    const VoxelizePlan plan = plan_range(g, options);
    const bool cuda = !executor::find_device().name.empty();
    device.report = &out.report;
    out.seconds = seconds_of([&] {
        LevelBuilder builder({});
        Progress silent;
        auto level0 = (cuda ? voxelize_on_cuda : voxelize_on_host_executor)(
            g, options, plan, device, silent, levels ? &builder : nullptr);
        if (levels) {
            out.levels = builder.finish(std::move(level0));
        } else {
            out.levels.push_back(std::move(level0));
        }
    });
    return out;
}

double cpu_seconds(const Geometry& g, const VoxelizeOptions& options) {
    const VoxelizePlan plan = plan_range(g, options);
    return seconds_of([&] {
        Progress silent;
        static_cast<void>(voxelize(g, options, plan, silent));
    });
}

/// Reads nodes from a file in their memory layout.
double read_seconds(const Geometry& g) {
    std::FILE* file = std::tmpfile();
    if (file == nullptr) return 0.0;
    for (const CurveSet& set : g.curves) {
        std::fwrite(set.points.data(), sizeof(Vec3f), set.points.size(), file);
    }
    std::rewind(file);
    const double seconds = seconds_of([&] {
        for (const CurveSet& set : g.curves) {
            std::vector<Vec3f> points(set.points.size());
            if (std::fread(points.data(), sizeof(Vec3f), points.size(), file) != points.size()) {
                std::fprintf(stderr, "speed: a temporary file is too short\n");
            }
        }
    });
    std::fclose(file);
    return seconds;
}

/// Writes the arrays of all blocks to a file in their memory layout.
double write_seconds(const VoxelLevels& levels, double& gigabytes) {
    std::FILE* file = std::tmpfile();
    if (file == nullptr) return 0.0;
    gigabytes = 0.0;
    const double seconds = seconds_of([&] {
        const auto write = [&](const auto& values) {
            gigabytes += 1e-9 * static_cast<double>(values.size() * sizeof(values[0]));
            std::fwrite(values.data(), sizeof(values[0]), values.size(), file);
        };
        for (const auto& level : levels) {
            VoxelBlock scratch;
            for (std::size_t b = 0; b < level->block_count(); ++b) {
                const VoxelBlock& block = level->block(b, scratch);
                write(block.leaves);
                VoxelBlock::for_each_array(block, write);
            }
        }
        std::fflush(file);
    });
    std::fclose(file);
    return seconds;
}

void print_row(const Row& row, bool with_cpu, const Peaks& peaks) {
    const Geometry g = cloth(row.shape, row.nodes, kFibers);
    VoxelizeOptions options;
    options.voxels = row.voxels;
    std::size_t points = 0;
    for (const CurveSet& set : g.curves) points += set.points.size();
    const Run first = run_device(g, options, {}, false); // fills the memory pool
    const Run level0 = run_device(g, options, {}, false);
    const Run levels = run_device(g, options, {}, true);
    const double read = read_seconds(g);
    double gigabytes = 0.0;
    const double write = write_seconds(levels.levels, gigabytes);
    DeviceOptions timing;
    timing.time_phases = true;
    const Run timed = run_device(g, options, timing, true);
    const double whole = read + levels.seconds + write;
    std::printf(
        "| %s, %.4g M nodes, %d | %.1f M | %.3f (first %.3f) | %.1f | %.3f | %.1f | %.3f, %.3f | %.1f | ",
        row.shape, 1e-6 * static_cast<double>(points) * kFibers, row.voxels,
        1e-6 * static_cast<double>(level0.levels[0]->info().voxel_count), level0.seconds,
        first.seconds, row.paper / level0.seconds, levels.seconds,
        row.paper_levels / levels.seconds, read, write, row.paper_levels / whole);
    if (with_cpu) {
        std::printf("%.2f |", cpu_seconds(g, options));
    } else {
        std::printf("- |");
    }
    for (const auto& [stage, seconds] : timed.report.stages) {
        std::printf(" %s %.1f ms,", stage.c_str(), 1e3 * seconds);
    }
    const double bytes = gigabytes * 1e9 + static_cast<double>(points) * sizeof(Vec3f);
    const double flops = static_cast<double>(points) * kFibers * kSamplesPerNode * kFlopsPerSample;
    const auto bound_ms = [](double work, double giga) {
        return giga > 0.0 ? 1e-6 * work / giga : 0.0;
    };
    std::printf(" bounds: bytes %.1f ms, arithmetic %.1f ms; %lld batches, %.2f GB |\n",
                bound_ms(bytes, peaks.gigabytes), bound_ms(flops, peaks.gigaflops),
                static_cast<long long>(levels.report.batches),
                1e-9 * static_cast<double>(levels.report.peak_bytes));
    std::fflush(stdout);
}

/// Times of launches alone, beside cuda_voxelizer's published times for a bunny with the same
/// number of triangles on a GTX 1050 Ti (112 GB/s), scaled by bandwidth.
void print_mesh(int voxels, double published_ms, double bandwidth) {
    const Geometry g = body(70000);
    VoxelizeOptions options;
    options.voxels = voxels;
    options.subvoxels = 1;
    DeviceOptions timing;
    timing.time_phases = true;
    static_cast<void>(run_device(g, options, timing, false));
    const Run run = run_device(g, options, timing, false);
    std::printf("| %zu triangles, %d voxels | %.1f M | %.2f | %.2f | %.2f |\n",
                g.meshes[0].triangles.size(), voxels,
                1e-6 * static_cast<double>(run.levels[0]->info().voxel_count),
                1e3 * (run.launches("bin") + run.launches("gather")), 1e3 * run.launches(),
                bandwidth > 0.0 ? published_ms * 112.0 / bandwidth : 0.0);
    std::fflush(stdout);
}

int main_of(int rows) {
    const executor::Device device = executor::find_device();
    const Peaks peaks;
    std::printf("device: %s\nthreads of the host: %d\n",
                device.name.empty() ? device.why.c_str() : device.name.c_str(), thread_count());
    std::printf("copies in the device's memory: %.0f GB/s; arithmetic: %.0f Gop/s\n\n",
                peaks.gigabytes, peaks.gigaflops);
    std::printf(
        "| cloth, nodes of fibers, voxels along the longest axis | voxels | level 0, s | paper / this | with levels, s | paper / this | read, write, s | paper / the whole | all cores of the CPU, level 0, s | launches |\n"
        "|---|---|---|---|---|---|---|---|---|---|\n");
    if (device.name.empty()) {
        print_row({"flat", 1e5, 128, 0.0, 0.0}, true, peaks);
    } else {
        for (int r = 0; r < rows; ++r) print_row(kRows[r], r % 3 == 0 && r < 6, peaks);
        if (rows == 9) print_row(kOtherReading, false, peaks);
    }
    std::printf(
        "\n| mesh, 1 subvoxel | voxels | bin and gather, ms | all launches, ms | cuda_voxelizer, published, scaled, ms |\n|---|---|---|---|---|\n");
    if (device.name.empty()) {
        print_mesh(128, 0.0, 0.0);
    } else {
        print_mesh(1024, 8.6, peaks.gigabytes);
        print_mesh(2048, 44.6, peaks.gigabytes);
    }
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
