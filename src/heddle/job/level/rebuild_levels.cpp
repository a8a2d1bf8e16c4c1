#include <heddle/job/level/rebuild_levels.h>

#include <heddle/base/memory.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/job/option_error.h>
#include <heddle/job/write_output.h>
#include <heddle/lod/rebuild_levels.h>

#include <utility>

namespace heddle::job {
namespace {

LodOptions asked_levels(const RebuildLevelsOptions& options) {
    LodOptions lod = lod_options(options.lod, options.levels, options.seed);
    if (!options.lobes) return lod;
    if (*options.lobes < 1 || *options.lobes > 8) {
        throw OptionError(str("`lobes` is ", *options.lobes, "; it must be 1 to 8"));
    }
    lod.max_lobes = *options.lobes;
    return lod;
}

/// Checks that memory holds the levels of the file and, at the same time, the new ones.
/// @throws Error  OutOfMemory: it does not
void check_memory(const std::vector<VoxelLevelInfo>& infos, const std::string& path) {
    std::int64_t needed = std::int64_t{64} << 20;
    for (const VoxelLevelInfo& info : infos) {
        const std::int64_t leaves = info.voxel_count / 16; // sparsely filled: 16 of 512 voxels
        const std::int64_t bytes =
            predict_block_bytes(leaves, info.voxel_count, info.lobe_count, info.fields);
        needed += info.level == 0 ? bytes : 2 * bytes;
    }
    if (needed <= available_bytes()) return;
    throw Error(ErrorCode::OutOfMemory,
                str("its levels need about ", needed >> 20, " MiB, but only ",
                    available_bytes() >> 20, " MiB are free"),
                "free some memory, or use a machine with more memory", {.path = path});
}

void report_levels(const VoxelLevels& levels, RebuildLevelsReport& report, Progress& progress) {
    report.counts = count_levels(levels);
    report.approximate = levels.front()->info().approximate;
    if (report.counts.voxels == 0) {
        take_notes(report.notes, {"the volume is empty: no voxel is covered"}, progress);
    }
    if (report.approximate) {
        take_notes(
            report.notes,
            {"the levels are approximate because the file holds no columns and sums (voxelize `keep_masks`)"},
            progress);
    }
}

void finish_report(RebuildLevelsReport& report, PhaseClock& clock) {
    clock.finish();
    report.phases = clock.phases();
    report.seconds = clock.seconds();
    report.peak_bytes = peak_resident_bytes();
}

} // namespace

RebuildLevelsResult
rebuild_levels(VoxelLevels levels, const RebuildLevelsOptions& options, Progress& progress) {
    PhaseClock clock(progress);
    const LodOptions lod = asked_levels(options);
    if (options.exact && !levels.front()->info().fields.masks) {
        throw OptionError("`exact` needs voxels with columns and sums");
    }
    RebuildLevelsResult result;
    result.levels = heddle::rebuild_levels(std::move(levels), lod, options.exact, clock);
    report_levels(result.levels, result.report, clock);
    progress.check();
    finish_report(result.report, clock);
    return result;
}

RebuildLevelsReport rebuild_levels_to_file(const std::string& path,
                                           const std::string& output,
                                           const RebuildLevelsOptions& options,
                                           Progress& progress) {
    PhaseClock clock(progress);
    const LodOptions lod = asked_levels(options);
    check_output(output, ".vdb");
    clock.begin("read", "files", 1);
    const std::vector<VoxelLevelInfo> infos = read_infos(path);
    check_memory(infos, path);
    if (options.exact && !infos.front().fields.masks) {
        throw Error(ErrorCode::BadFile,
                    "holds no columns and sums, so its levels would be approximate",
                    "voxelize it with `keep_masks`, or leave out `exact`", {.path = path});
    }
    VoxelLevels levels = read_levels(path);
    clock.check();
    levels = heddle::rebuild_levels(std::move(levels), lod, options.exact, clock);
    write_output([&] { write_vdb(levels, output, clock); });
    RebuildLevelsReport report;
    report_levels(levels, report, clock);
    finish_report(report, clock);
    return report;
}

} // namespace heddle::job
