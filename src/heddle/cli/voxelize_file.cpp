#include <heddle/cli/voxelize_file.h>

#include <heddle/base/memory.h>
#include <heddle/cli/device_options.h>
#include <heddle/cli/fill_memory.h>
#include <heddle/cli/level_options.h>
#include <heddle/cli/load.h>
#include <heddle/cli/terminal/text.h>
#include <heddle/cli/voxel_options.h>
#include <heddle/cli/voxelize_raster.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/voxelize/voxelize.h>

#include <chrono>
#include <filesystem>

namespace heddle::cli {
namespace {

using Clock = std::chrono::steady_clock;

VoxelizeOptions voxelize_options(const Arguments& arguments, const std::string& output) {
    VoxelizeOptions options = resolution_from(arguments);
    if (arguments.given("fill-memory") &&
        (arguments.given("voxels") || arguments.given("voxel-size"))) {
        throw UsageError(
            "--fill-memory chooses the resolution; leave out --voxels and --voxel-size");
    }
    if (arguments.given("bounds")) {
        const std::vector<double> b = arguments.numbers("bounds");
        options.bounds = Bounds{{b[0], b[1], b[2]}, {b[3], b[4], b[5]}};
        if (options.bounds->empty()) {
            throw UsageError("--bounds: the first corner must be the lower one on every axis");
        }
    }
    options.subvoxels = static_cast<std::int32_t>(arguments.integer("subvoxels"));
    options.max_lobes = static_cast<std::int32_t>(arguments.integer("lobes"));
    options.coverage =
        arguments.text("coverage") == "mask" ? CoverageMode::Mask : CoverageMode::Columns;
    options.fit = arguments.text("fit") == "last" ? FitMode::Last : FitMode::Moments;
    options.samples = arguments.integer("samples");
    if (options.samples > 0 && options.coverage != CoverageMode::Mask) {
        throw UsageError(
            "--samples needs --coverage mask; columns are computed without random samples");
    }
    if (arguments.given("memory")) options.memory_bytes = arguments.bytes("memory");
    if (arguments.given("footprints")) {
        options.footprints = static_cast<std::int32_t>(arguments.integer("footprints"));
    }
    options.correlation = arguments.given("correlation");
    if (arguments.text("lod") == "naive" && (options.footprints != 0 || options.correlation)) {
        throw UsageError(
            "--footprints and --correlation cannot be used with --lod naive, which averages coverage");
    }
    options.keep_sums = arguments.given("keep-masks");
    options.seed = static_cast<std::uint64_t>(arguments.integer("seed"));
    const std::string folder = std::filesystem::path(output).parent_path().string();
    options.spool_dir = folder.empty() ? "." : folder;
    options.command = arguments.command_line;
    return options;
}

/// @return  bytes of the .vdb, predicted
std::int64_t report_plan(Report& report, const VoxelizePlan& plan) {
    const Vec3d size = plan.lattice.voxel_size;
    report.add("voxel_size", "voxel size", {size.x, size.y, size.z},
               str(size.x, " x ", size.y, " x ", size.z, " scene units"));
    const Vec3i n = plan.voxel_hi - plan.voxel_lo;
    report.add("resolution", "resolution", {n.x, n.y, n.z},
               str(n.x, " x ", n.y, " x ", n.z, " voxels, ", plan.lattice.subvoxels,
                   " subvoxels per voxel axis"));
    const std::int64_t predicted = report_work(report, plan);
    report.count("blocks", plan.blocks, str("of ", plan.block_voxels, "^3 voxels"));
    report.count("batches", plan.batches, plan.spool ? "with a temporary file" : "");
    report.number("step length", plan.step_length, "scene units");
    report.number("chord error", plan.chord_error, "subvoxels");
    return predicted;
}

std::int64_t file_bytes(const std::string& path) {
    std::error_code ignored;
    const auto size = std::filesystem::file_size(path, ignored);
    return ignored ? 0 : static_cast<std::int64_t>(size);
}

/// The file's curves and meshes as they are to be voxelized, and what follows from them for `options`.
Geometry
read_input(const Arguments& arguments, const std::string& input, VoxelizeOptions& options) {
    Geometry geometry = load_geometry(input, arguments);
    apply_model(geometry, arguments);
    prepare_backend(geometry, arguments);
    if (!arguments.given("footprints") && geometry.meshes.empty() &&
        arguments.text("lod") != "naive") {
        options.footprints = 4; // transport through fibers needs them: docs/transport.md
    }
    return geometry;
}

void report_written(Report& report,
                    const std::string& output,
                    const VoxelLevels& levels,
                    const LevelBuilder* builder,
                    const ProgressBar& bar) {
    report.text("output", output);
    report_levels(report, levels);
    if (builder != nullptr) {
        report.add("levels_thread_seconds", "building levels", builder->visit_seconds(),
                   str(show_seconds(builder->visit_seconds()),
                       " summed over all threads, while voxelizing"));
    }
    report.bytes("file size", file_bytes(output));
    for (const auto& [stage, seconds] : bar.stages()) report.seconds(stage, seconds);
}

} // namespace

VoxelizedFile voxelize_file(const Arguments& arguments,
                            const std::string& input,
                            const std::string& output,
                            raster::SliceVoxelizer& drawer,
                            Report& report,
                            ProgressBar& bar) {
    const auto start = Clock::now();
    VoxelizeOptions options = voxelize_options(arguments, output);
    bar.begin("read", "files", 1);
    Geometry geometry = read_input(arguments, input, options);
    const DeviceChoice device =
        uses_raster(arguments) ? DeviceChoice{} : choose_device(arguments, options, report);
    bar.check();
    bar.begin("plan", "files", 1);
    const std::unique_ptr<LevelBuilder> builder = level_builder(arguments);
    const auto plan_of = [&](const VoxelizeOptions& how, LevelBuilder* levels) {
        VoxelizePlan out = plan_voxelize(geometry, how, bar, levels);
        if (!uses_raster(arguments)) return out;
        out.peak_bytes += drawer.predict_bytes(geometry, how, out);
        out.seconds = 0.0; // it was measured of fibers; of a driver nothing is known
        return out;
    };
    if (arguments.given("fill-memory")) {
        options.voxels = voxels_that_fit(options, [&](const VoxelizeOptions& how) {
            return plan_of(how, level_builder(arguments).get());
        });
    }
    const VoxelizePlan plan = plan_of(options, builder.get());
    bar.finish();
    for (const std::string& note : geometry.notes) report.note(note);
    const std::int64_t predicted = report_plan(report, plan);
    if (arguments.given("dry-run")) {
        return {plan.voxels, predicted, plan.peak_bytes, plan.seconds};
    }
    VoxelLevels levels = finish_levels(
        builder.get(),
        uses_raster(arguments)
            ? voxelize_raster(geometry, options, plan, drawer, bar, builder.get(), report)
            : voxelize_where(device, geometry, options, plan, bar, builder.get(), report));
    geometry = {}; // its memory is better used by the writer
    write_output([&] { write_vdb(levels, output, bar); });
    bar.finish();
    report_written(report, output, levels, builder.get(), bar);
    const std::chrono::duration<double> total = Clock::now() - start;
    report.seconds("total", total.count());
    report.bytes("peak memory", peak_resident_bytes());
    return {levels.front()->info().voxel_count, file_bytes(output), plan.peak_bytes, total.count()};
}

} // namespace heddle::cli
