#include <heddle/cli/voxelize/vol.h>

#include <heddle/base/error.h>
#include <heddle/cli/rows/level_rows.h>
#include <heddle/cli/rows/report_parts.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/voxelize/voxelize.h>
#include <heddle/job/voxelize/voxelize_vol.h>

#include <set>
#include <string>

namespace heddle::cli {
namespace {

/// Refuses every option of `voxelize` that a volume has no use for.
void reject_other_rows(const Arguments& arguments) {
    std::set<std::string> used{"FILE", "output", "dry-run", "lobes", "occupancy", "memory"};
    for (const std::vector<Option>& rows : {level_rows(), vol_rows()}) {
        for (const Option& row : rows) used.insert(row.key());
    }
    for (const Option& row : voxelize_command().options) {
        if (used.contains(row.key()) || !arguments.given(row.key())) continue;
        throw UsageError(
            str("--", row.key(), " cannot be used with a .vol, whose samples become the voxels"));
    }
}

job::VolJobOptions vol_options_from(const Arguments& arguments) {
    job::VolJobOptions options;
    options.orientation = arguments.find_text("orientation").value_or("");
    options.density_scale = arguments.find_number("density-scale");
    const std::vector<double> rgb = arguments.numbers("albedo");
    const bool grey = rgb.size() == 1;
    options.albedo = to_float({rgb[0], grey ? rgb[0] : rgb[1], grey ? rgb[0] : rgb[2]});
    options.lobes = static_cast<std::int32_t>(arguments.integer("lobes"));
    options.lod = lod_method_from(arguments);
    options.levels = level_count_from(arguments);
    options.occupancy = arguments.integer("occupancy") != 0;
    options.seed = static_cast<std::uint64_t>(arguments.integer("seed"));
    options.memory_bytes = arguments.find_bytes("memory");
    options.command = arguments.command_line;
    return options;
}

} // namespace

std::vector<Option> vol_rows() {
    return grouped(
        "Mitsuba volumes (.vol)",
        {
            {"--orientation", "FILE", "(found by its name)", any_text(), "",
             "Orientation file of a .vol volume, or any one orientation file of a dictionary; 'none' ignores orientation."},
            {"--density-scale", "S", "(2 / voxel size: density 1 covers 86 % of a voxel's face)",
             positive(), "per scene unit",
             "Extinction at density 1, which is 'scale' in a Mitsuba scene."},
            {"--albedo", "R[,G,B]", "0.8", numbers(1, 3, 0.0, 1.0), "linear",
             "Albedo of the fibers."},
        });
}

void reject_vol_rows(const Arguments& arguments) {
    for (const Option& row : vol_rows()) {
        if (!arguments.given(row.key())) continue;
        throw UsageError(str("--", row.key(), " applies only to .vol files"));
    }
}

void voxelize_vol(const Arguments& arguments, Report& report, ProgressBar& bar) {
    reject_other_rows(arguments);
    const std::string& path = arguments.text("FILE");
    const job::VolJobOptions options = vol_options_from(arguments);
    if (arguments.given("dry-run")) {
        return report_vol(report, job::plan_vol(path, options, bar).layout);
    }
    const std::string& output = arguments.text("output");
    const job::VolReport done = job::voxelize_vol_to_file(path, output, options, bar);
    report_vol(report, done.layout);
    report_notes(report, done.notes);
    report.text("output", output);
    report_levels(report, done.counts);
    report.bytes("file size", done.file_bytes);
    report_phases(report, done.phases);
    report_cost(report, done.seconds, done.peak_bytes);
}

} // namespace heddle::cli
