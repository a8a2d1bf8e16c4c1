#include <heddle/job/voxelize/voxelize_vol.h>

#include <heddle/base/memory.h>
#include <heddle/base/parallel.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/io/vol/read_vol.h>
#include <heddle/job/option_error.h>
#include <heddle/job/write_output.h>
#include <heddle/lod/rebuild_levels.h>

#include <utility>

namespace heddle::job {
namespace {

void check_vol_options(const VolJobOptions& o) {
    if (o.density_scale && !(*o.density_scale > 0.0)) {
        throw OptionError(str("`density_scale` is ", *o.density_scale, "; it must be > 0"));
    }
    if (o.lobes < 1 || o.lobes > 8) {
        throw OptionError(str("`lobes` is ", o.lobes, "; it must be 1 to 8"));
    }
    for (int a = 0; a < 3; ++a) {
        if (o.albedo[a] >= 0.0f && o.albedo[a] <= 1.0f) continue;
        throw OptionError(str("`albedo` is ", o.albedo[a], "; it must be 0 to 1"));
    }
    (void)lod_options(o.lod, o.levels, o.seed);
}

VolLayout find_layout(const std::string& path, const VolJobOptions& options, PhaseClock& clock) {
    check_vol_options(options);
    clock.begin("find", "files", 1);
    VolLayout layout = find_vol_layout(path, options.orientation);
    clock.finish();
    return layout;
}

/// Decodes all blocks into memory if they fit: building levels and writing each grid visit all of
/// them, and the source decodes them anew on every visit.
std::unique_ptr<VoxelLevel> hold(std::unique_ptr<VoxelLevel> source,
                                 const std::optional<std::int64_t>& memory_bytes,
                                 Progress& progress) {
    const VoxelLevelInfo& info = source->info();
    const std::int64_t limit = memory_bytes.value_or(available_bytes() / 2);
    const std::int64_t leaves = info.voxel_count / 8; // an upper bound if sparsely filled
    if (2 * predict_block_bytes(leaves, info.voxel_count, info.lobe_count, info.fields) > limit) {
        return source;
    }
    auto grid = std::make_unique<MemoryLevel>();
    grid->set_info(info);
    grid->blocks.resize(source->block_count());
    progress.begin("decode", "blocks", static_cast<std::int64_t>(grid->blocks.size()));
    parallel_chunks(grid->blocks.size(), 1, [&](std::size_t i, std::size_t) {
        progress.check();
        VoxelBlock scratch;
        grid->blocks[i] = source->block(i, scratch);
        progress.advance(1);
    });
    return grid;
}

VoxelLevels make_levels(const VolJobOptions& options, VolReport& report, PhaseClock& clock) {
    VolVolume volume = read_vol(report.layout,
                                {.density_scale = options.density_scale.value_or(0.0),
                                 .albedo = options.albedo,
                                 .max_lobes = options.lobes,
                                 .occupancy = options.occupancy,
                                 .command = options.command},
                                clock);
    clock.finish();
    take_notes(report.notes, volume.notes, clock);
    VoxelLevels levels;
    levels.push_back(hold(std::move(volume.grid), options.memory_bytes, clock));
    const LodOptions lod = lod_options(options.lod, options.levels, options.seed);
    if (lod.max_levels > 0) levels = rebuild_levels(std::move(levels), lod, false, clock);
    report.counts = count_levels(levels);
    if (report.counts.voxels == 0) {
        take_notes(report.notes, {"the volume is empty: no voxel is covered"}, clock);
    }
    return levels;
}

void finish_report(VolReport& report, PhaseClock& clock) {
    clock.finish();
    report.phases = clock.phases();
    report.seconds = clock.seconds();
    report.peak_bytes = peak_resident_bytes();
}

} // namespace

bool is_vol_file(const std::string& path) {
    return suffix_of(path) == ".vol";
}

VolReport plan_vol(const std::string& path, const VolJobOptions& options, Progress& progress) {
    PhaseClock clock(progress);
    VolReport report;
    report.layout = find_layout(path, options, clock);
    return report;
}

VolResult voxelize_vol(const std::string& path, const VolJobOptions& options, Progress& progress) {
    PhaseClock clock(progress);
    VolResult result;
    result.report.layout = find_layout(path, options, clock);
    result.levels = make_levels(options, result.report, clock);
    progress.check();
    finish_report(result.report, clock);
    return result;
}

VolReport voxelize_vol_to_file(const std::string& path,
                               const std::string& output,
                               const VolJobOptions& options,
                               Progress& progress) {
    PhaseClock clock(progress);
    check_output(output, ".vdb");
    VolReport report;
    report.layout = find_layout(path, options, clock);
    const VoxelLevels levels = make_levels(options, report, clock);
    write_output([&] { write_vdb(levels, output, clock); });
    report.file_bytes = file_bytes(output);
    finish_report(report, clock);
    return report;
}

} // namespace heddle::job
