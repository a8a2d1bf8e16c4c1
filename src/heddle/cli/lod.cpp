#include <heddle/cli/commands.h>
#include <heddle/cli/rows/level_rows.h>
#include <heddle/cli/rows/report_parts.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/job/level/rebuild_levels.h>

namespace heddle::cli {
namespace {

job::RebuildLevelsOptions lod_options_from(const Arguments& arguments) {
    job::RebuildLevelsOptions options;
    options.lod = lod_method_from(arguments);
    options.levels = level_count_from(arguments);
    if (arguments.given("lobes")) options.lobes = static_cast<int>(arguments.integer("lobes"));
    options.exact = arguments.given("exact");
    options.seed = static_cast<std::uint64_t>(arguments.integer("seed"));
    return options;
}

void run_lod(const Arguments& arguments, Report& report, ProgressBar& bar) {
    const std::string& output = arguments.text("output");
    const job::RebuildLevelsReport done = job::rebuild_levels_to_file(
        arguments.text("FILE"), output, lod_options_from(arguments), bar);
    report.text("output", output);
    report_levels(report, done.counts);
    report_notes(report, done.notes);
    report_phases(report, done.phases);
    report_cost(report, done.seconds, done.peak_bytes);
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
            level_rows(),
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
