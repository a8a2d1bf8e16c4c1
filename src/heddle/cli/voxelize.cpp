#include <heddle/base/memory.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/device_options.h>
#include <heddle/cli/level_options.h>
#include <heddle/cli/load.h>
#include <heddle/cli/progress_bar.h>
#include <heddle/cli/report.h>
#include <heddle/cli/text.h>
#include <heddle/cli/voxel_options.h>
#include <heddle/cli/voxelize_raster.h>
#include <heddle/cli/voxelize_vol.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/voxel/voxelize.h>

#include <chrono>
#include <filesystem>
#include <limits>

namespace heddle::cli {
namespace {

VoxelizeOptions voxelize_options(const Arguments& arguments, const std::string& output) {
    VoxelizeOptions options = resolution_from(arguments);
    if (arguments.given("bounds")) {
        const std::vector<double> b = arguments.numbers("bounds");
        options.bounds = Bounds{{b[0], b[1], b[2]}, {b[3], b[4], b[5]}};
        if (options.bounds->empty()) {
            throw UsageError("--bounds: its first corner must be the lower one on every axis");
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
            "--samples is of no use without --coverage mask: nothing is left to chance");
    }
    if (arguments.given("memory")) options.memory_bytes = arguments.bytes("memory");
    if (arguments.given("footprints")) {
        options.footprints = static_cast<std::int32_t>(arguments.integer("footprints"));
    }
    options.correlation = arguments.given("correlation");
    if (arguments.text("lod") == "naive" && (options.footprints != 0 || options.correlation)) {
        throw UsageError("--lod naive averages coverage: it has no footprints and no correlation");
    }
    options.keep_sums = arguments.given("keep-masks");
    options.seed = static_cast<std::uint64_t>(arguments.integer("seed"));
    const std::string folder = std::filesystem::path(output).parent_path().string();
    options.spool_dir = folder.empty() ? "." : folder;
    options.command = arguments.command_line;
    return options;
}

void report_plan(Report& report, const VoxelizePlan& plan) {
    const Vec3d size = plan.lattice.voxel_size;
    report.add("voxel_size", "voxel size", {size.x, size.y, size.z},
               str(size.x, " x ", size.y, " x ", size.z, " scene units"));
    const Vec3i n = plan.voxel_hi - plan.voxel_lo;
    report.add("resolution", "resolution", {n.x, n.y, n.z},
               str(n.x, " x ", n.y, " x ", n.z, " voxels, ", plan.lattice.subvoxels,
                   " subvoxels each way in one"));
    report_work(report, plan);
    report.count("blocks", plan.blocks, str("of ", plan.block_voxels, " voxels each way"));
    report.count("batches", plan.batches, plan.spool ? "with a temporary file" : "");
    report.number("step length", plan.step_length, "scene units");
    report.number("chord error", plan.chord_error, "subvoxels");
}

std::int64_t file_bytes(const std::string& path) {
    std::error_code ignored;
    const auto size = std::filesystem::file_size(path, ignored);
    return ignored ? 0 : static_cast<std::int64_t>(size);
}

void run_voxelize(const Arguments& arguments, Report& report, ProgressBar& bar) {
    if (is_volume(arguments)) return voxelize_volume(arguments, report, bar);
    refuse_volume_options(arguments);
    const auto start = std::chrono::steady_clock::now();
    const std::string output = arguments.text("output");
    VoxelizeOptions options = voxelize_options(arguments, output);
    const bool dry_run = arguments.given("dry-run");
    if (!dry_run) check_output(output, ".vdb");
    bar.begin("read", "files", 1);
    Geometry geometry = load_geometry(arguments.text("FILE"), arguments);
    apply_model(geometry, arguments);
    prepare_backend(geometry, arguments);
    if (!arguments.given("footprints") && geometry.meshes.empty() &&
        arguments.text("lod") != "naive") {
        options.footprints = 4; // transport through fibers needs them: docs/transport.md
    }
    const DeviceChoice device =
        uses_raster(arguments) ? DeviceChoice{} : choose_device(arguments, options, report);
    bar.check();
    bar.begin("plan", "files", 1);
    std::unique_ptr<LevelBuilder> levels_above = level_builder(arguments);
    const VoxelizePlan plan = plan_voxelize(geometry, options, bar, levels_above.get());
    bar.finish();
    for (const std::string& note : geometry.notes) report.note(note);
    report_plan(report, plan);
    if (dry_run) return;

    VoxelLevels levels = finish_levels(
        levels_above.get(),
        uses_raster(arguments)
            ? voxelize_raster(geometry, options, plan, arguments, bar, levels_above.get(), report)
            : voxelize_where(device, geometry, options, plan, bar, levels_above.get(), report));
    geometry = {}; // its memory is better used by the writer
    write_output([&] { write_vdb(levels, output, bar); });
    bar.finish();
    report.text("output", output);
    report_levels(report, levels);
    if (levels_above) {
        report.add(
            "levels_thread_seconds", "levels", levels_above->visit_seconds(),
            str(show_seconds(levels_above->visit_seconds()), " of all threads, within voxelize"));
    }
    report.bytes("file size", file_bytes(output));
    for (const auto& [stage, seconds] : bar.stages()) report.seconds(stage, seconds);
    const std::chrono::duration<double> total = std::chrono::steady_clock::now() - start;
    report.seconds("total", total.count());
    report.bytes("peak memory", peak_resident_bytes());
}

} // namespace

Command voxelize_command() {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    std::vector<Option> options{
        {"FILE", "", "", any_text(), "",
         "curves: .bcc .hair .data .pyp; meshes: .obj .ply .gltf .glb; volumes: .vol", true},
        {"-o, --output", "OUT.vdb", "", any_text(), "", "where the volume goes", true},
    };
    const auto add = [&options](const std::vector<Option>& more) {
        options.insert(options.end(), more.begin(), more.end());
    };
    add(resolution_options());
    add({{"--bounds", "X0,Y0,Z0,X1,Y1,Z1", "(all of the object)", numbers(6, 6, -kInf, kInf),
          "scene units", "keeps the voxels that touch this box"}});
    add(load_options());
    add(model_options());
    add(volume_options());
    add({
        {"--lobes", "K", "3", integer(1, 8), "", "most orientation lobes in a voxel"},
        {"--subvoxels", "N", "8", one_of({"1", "2", "4", "8"}), "per voxel axis",
         "how finely coverage is measured"},
        {"--coverage", "MODE", "columns", one_of({"columns", "mask"}), "",
         "columns: by centre rays; mask: by sampled subvoxels, as [Fabre26]"},
        {"--samples", "N", "0", integer(0, 1'000'000), "per span",
         "with --coverage mask; 0 = two a subvoxel"},
        {"--fit", "MODE", "moments", one_of({"moments", "last"}), "",
         "moments: all directions count; last: one sample's, as earlier voxelizers"},
    });
    add(raster_options());
    add(level_options());
    add({
        {"--footprints", "N", "(4 of yarn and hair, else 0)", one_of({"0", "4", "8"}),
         "cells per axis",
         "keeps which parts of a voxel's faces are covered, for transport; 0 = no"},
        {"--correlation", "", "", flag(), "",
         "keeps how far neighbouring voxels hide the same, for transport: a byte a face"},
        {"--keep-masks", "", "", flag(), "",
         "stores columns and sums: 'heddle lod' then builds the same levels again, bit for bit"},
        {"--memory", "BYTES", "(half of what is free)", bytes(), "K, M, G",
         "peak memory that is kept to"},
        {"--dry-run", "", "", flag(), "", "prints the plan and writes nothing"},
    });
    add(device_options());
    return {"voxelize", "a .vdb with orientations and coverage, from curves, meshes or volumes",
            options, run_voxelize};
}

} // namespace heddle::cli
