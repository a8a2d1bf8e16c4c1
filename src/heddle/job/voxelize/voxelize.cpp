#include <heddle/job/voxelize/voxelize.h>

#include <heddle/base/memory.h>
#include <heddle/io/vdb/predict_vdb.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/job/voxelize/choose_device.h>
#include <heddle/job/voxelize/fill_memory.h>
#include <heddle/job/write_output.h>
#include <heddle/yarn/slice_image.h>

#include <filesystem>
#include <utility>

namespace heddle::job {

/// The state of one input that is voxelized.
struct Voxelizer::Run {
    explicit Run(Progress& progress) : clock(progress) {}

    PhaseClock clock;
    Geometry geometry;
    VoxelizeOptions options;
    ChosenDevice device;
    std::unique_ptr<LevelBuilder> builder; ///< null: level 0 alone
    VoxelizeReport report;
};

namespace {

std::string folder_of(const std::string& output) {
    const std::string folder = std::filesystem::path(output).parent_path().string();
    return folder.empty() ? "." : folder;
}

/// Returns level 0 and the levels that `builder` built above it.
VoxelLevels finish_levels(LevelBuilder* builder, std::unique_ptr<VoxelLevel> level0) {
    if (builder != nullptr) return builder->finish(std::move(level0));
    VoxelLevels levels;
    levels.push_back(std::move(level0));
    return levels;
}

void finish_report(VoxelizeReport& report, PhaseClock& clock) {
    clock.finish();
    report.phases = clock.phases();
    report.seconds = clock.seconds();
    report.peak_bytes = peak_resident_bytes();
}

} // namespace

Voxelizer::Voxelizer(VoxelizeJobOptions options)
    : options_(std::move(options)), slice_voxelizer_(raster_options(options_)) {
    check_voxelize_options(options_);
}

Voxelizer::~Voxelizer() = default;

std::unique_ptr<LevelBuilder> Voxelizer::make_builder() const {
    const LodOptions lod = lod_options(options_.lod, options_.levels, options_.seed);
    if (lod.max_levels == 0 && !options_.correlation) return nullptr;
    return std::make_unique<LevelBuilder>(lod); // it also computes the correlation of level 0
}

VoxelizePlan Voxelizer::plan_of(const Run& run,
                                const VoxelizeOptions& options,
                                LevelBuilder* builder,
                                Progress& clock) {
    VoxelizePlan plan = heddle::plan_voxelize(run.geometry, options, clock, builder);
    if (options_.backend != Backend::Raster) return plan;
    plan.peak_bytes += slice_voxelizer_.predict_bytes(run.geometry, options, plan);
    plan.seconds = 0.0; // the prediction is for fibers, not for OpenGL
    return plan;
}

/// Reads the input and plans its voxelization.
std::unique_ptr<Voxelizer::Run> Voxelizer::prepare(GeometryInput input,
                                                   const std::string& folder,
                                                   bool writes,
                                                   Progress& progress) {
    auto run = std::make_unique<Run>(progress);
    PhaseClock& clock = run->clock;
    clock.begin("read", "files", 1);
    run->geometry = load_geometry(std::move(input));
    std::vector<std::string> notes = run->geometry.notes;
    if (options_.backend == Backend::Raster) {
        for (std::string& note : make_slices_of_yarns(run->geometry, options_.seed)) {
            notes.push_back(std::move(note));
        }
    }
    run->options = voxelizer_options(options_, run->geometry.meshes.empty());
    if (!options_.spool_dir) run->options.spool_dir = folder;
    if (writes) {
        run->options.writer_bytes = kVdbWriterBytes;
        run->options.writer_bytes_per_leaf = kVdbWriterBytesPerLeaf;
    }
    run->device = choose_device(options_, run->options);
    clock.check();
    clock.begin("plan", "files", 1);
    run->builder = make_builder();
    if (options_.fill_memory) {
        run->options.voxels =
            resolution_for_memory(run->options, [&](const VoxelizeOptions& tried) {
                return plan_of(*run, tried, make_builder().get(), clock);
            });
    }
    run->report.plan = plan_of(*run, run->options, run->builder.get(), clock);
    clock.finish();
    take_notes(run->report.notes, notes, clock);
    run->report.predicted_file_bytes = predict_file_bytes(run->report.plan);
    if (run->device.cuda) run->report.device = DeviceUse{.name = run->device.name};
    return run;
}

std::unique_ptr<VoxelLevel> Voxelizer::make_voxels(Run& run) {
    const VoxelizePlan& plan = run.report.plan;
    PhaseClock& clock = run.clock;
    if (options_.backend == Backend::Raster) {
        raster::RasterCounts& counts = run.report.raster.emplace();
        return slice_voxelizer_.voxelize(run.geometry, run.options, plan, clock, run.builder.get(),
                                         &counts);
    }
    if (!run.device.cuda) {
        return heddle::voxelize(run.geometry, run.options, plan, clock, run.builder.get());
    }
    DeviceReport took;
    DeviceOptions device{.memory_bytes = run.device.memory_bytes, .report = &took};
    std::unique_ptr<VoxelLevel> made =
        voxelize_on_cuda(run.geometry, run.options, plan, device, clock, run.builder.get());
    run.report.device->peak_bytes = took.peak_bytes;
    run.report.device->batches = took.batches;
    run.report.device->upload_seconds = took.upload_seconds;
    return made;
}

/// Computes voxels and levels, then frees the geometry, so that writing has more memory.
VoxelLevels Voxelizer::make_levels(Run& run) {
    VoxelLevels levels = finish_levels(run.builder.get(), make_voxels(run));
    run.geometry = {};
    if (run.builder) run.report.levels_thread_seconds = run.builder->visit_seconds();
    run.report.counts = count_levels(levels);
    if (run.report.counts.voxels == 0) {
        take_notes(run.report.notes, {"the volume is empty: no voxel is covered"}, run.clock);
    }
    return levels;
}

VoxelizeReport Voxelizer::plan(GeometryInput input, Progress& progress) {
    const std::unique_ptr<Run> run = prepare(std::move(input), ".", true, progress);
    finish_report(run->report, run->clock);
    return std::move(run->report);
}

VoxelizeResult Voxelizer::voxelize(GeometryInput input, Progress& progress) {
    const std::unique_ptr<Run> run = prepare(std::move(input), ".", false, progress);
    VoxelLevels levels = make_levels(*run);
    progress.check();
    finish_report(run->report, run->clock);
    return {std::move(levels), std::move(run->report)};
}

VoxelizeReport
Voxelizer::voxelize_to_file(GeometryInput input, const std::string& output, Progress& progress) {
    check_output(output, ".vdb");
    const std::unique_ptr<Run> run = prepare(std::move(input), folder_of(output), true, progress);
    const VoxelLevels levels = make_levels(*run);
    write_output([&] { write_vdb(levels, output, run->clock); });
    run->report.file_bytes = file_bytes(output);
    finish_report(run->report, run->clock);
    return std::move(run->report);
}

VoxelizeReport
plan_voxelize(GeometryInput input, const VoxelizeJobOptions& options, Progress& progress) {
    return Voxelizer(options).plan(std::move(input), progress);
}

VoxelizeResult
voxelize(GeometryInput input, const VoxelizeJobOptions& options, Progress& progress) {
    return Voxelizer(options).voxelize(std::move(input), progress);
}

VoxelizeReport voxelize_to_file(GeometryInput input,
                                const std::string& output,
                                const VoxelizeJobOptions& options,
                                Progress& progress) {
    return Voxelizer(options).voxelize_to_file(std::move(input), output, progress);
}

} // namespace heddle::job
