#include <heddle/base/error.h>
#include <heddle/base/memory.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/level_options.h>
#include <heddle/cli/load.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/lod/rebuild_levels.h>

#include <chrono>

namespace heddle::cli {
namespace {

/// The file's levels, and those that are built while the old ones are there.
/// @throws Error  OutOfMemory
void check_memory(const std::vector<VoxelGridInfo>& infos, const std::string& path) {
    std::int64_t needed = std::int64_t{64} << 20;
    for (const VoxelGridInfo& info : infos) {
        const std::int64_t leaves = info.voxel_count / 16; // of 512 voxels, thinly filled
        const std::int64_t bytes =
            predict_block_bytes(leaves, info.voxel_count, info.lobe_count, info.fields);
        needed += info.level == 0 ? bytes : 2 * bytes;
    }
    if (needed <= available_bytes()) return;
    throw Error(ErrorCode::OutOfMemory,
                str("its levels need about ", needed >> 20, " MiB, but only ",
                    available_bytes() >> 20, " MiB are free"),
                "free some memory, or use a machine with more", {.path = path});
}

void run_lod(const Arguments& arguments, Report& report, ProgressBar& bar) {
    const auto start = std::chrono::steady_clock::now();
    const std::string output = arguments.text("output");
    LodOptions options = lod_options(arguments);
    if (arguments.given("lobes")) {
        options.max_lobes = static_cast<int>(arguments.integer("lobes"));
    }
    check_output(output, ".vdb");
    bar.begin("read", "files", 1);
    const std::string& path = arguments.text("FILE");
    const std::vector<VoxelGridInfo> infos = read_infos(path);
    check_memory(infos, path);
    if (arguments.given("exact") && !infos.front().fields.masks) {
        throw Error(ErrorCode::BadFile,
                    "holds no columns and sums, so its levels would be approximate",
                    "voxelize it with --keep-masks, or leave out --exact", {.path = path});
    }
    VoxelLevels levels = read_levels(path);
    bar.check();
    levels = rebuild_levels(std::move(levels), options, arguments.given("exact"), bar);
    write_output([&] { write_vdb(levels, output, bar); });
    bar.finish();
    report.text("output", output);
    report_levels(report, levels);
    if (levels.front()->info().approximate) {
        report.note(
            "the levels are approximate because the file holds no columns and sums (voxelize --keep-masks)");
    }
    for (const auto& [stage, seconds] : bar.stages()) report.seconds(stage, seconds);
    const std::chrono::duration<double> total = std::chrono::steady_clock::now() - start;
    report.seconds("total", total.count());
    report.bytes("peak memory", peak_resident_bytes());
}

} // namespace

Command lod_command() {
    return {
        "lod", "Rebuilds the levels of detail of a .vdb.",
        joined({
            grouped("Input and output",
                    {
                        {"FILE", "", "", any_text(), "", "A .vdb written by heddle.", true},
                        {"-o, --output", "OUT.vdb", "", any_text(), "", "Output volume.", true},
                    }),
            level_options(),
            grouped(
                "Levels of detail",
                {
                    {"--lobes", "K", "(as in the file)", integer(1, 8), "",
                     "Maximum number of orientation lobes per voxel above the finest level."},
                    {"--exact", "", "", flag(), "",
                     "Fails if the levels would be approximate, because the file was written without --keep-masks."},
                }),
        }),
        run_lod};
}

} // namespace heddle::cli
