#include <heddle/base/error.h>
#include <heddle/base/nearest_name.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/level_table.h>
#include <heddle/cli/rows/report_parts.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/terminal/text.h>
#include <heddle/job/level/measure_levels.h>

#include <algorithm>

namespace heddle::cli {
namespace {

std::vector<LodMethod> methods_from(const Arguments& arguments) {
    std::vector<LodMethod> out;
    for (const std::string& name : split(arguments.text("methods"), ',')) {
        const std::optional<LodMethod> method = lod_method_of(name);
        if (!method) {
            const std::string_view near = nearest_name(name, kLodMethodNames);
            std::string all;
            for (const char* known : kLodMethodNames) all += str(all.empty() ? "" : ", ", known);
            throw UsageError(str("--methods: '", name, "' is not one of ", all,
                                 near.empty() ? "" : str("; did you mean '", near, "'?")));
        }
        if (std::find(out.begin(), out.end(), *method) == out.end()) out.push_back(*method);
    }
    return out;
}

job::MeasureLevelsOptions measure_options_from(const Arguments& arguments) {
    job::MeasureLevelsOptions options;
    options.methods = methods_from(arguments);
    options.parents = static_cast<int>(arguments.integer("parents"));
    options.part = arguments.find_integer("part");
    if (arguments.given("lobes")) options.lobes = static_cast<int>(arguments.integer("lobes"));
    options.seed = static_cast<std::uint64_t>(arguments.integer("seed"));
    options.plot = arguments.find_text("plot");
    return options;
}

void run_lod_report(const Arguments& arguments, Report& report, ProgressBar& bar) {
    const job::LevelTable table =
        job::measure_levels(arguments.text("FILE"), measure_options_from(arguments), bar);
    report_notes(report, table.notes);
    add_json(table, report);
    report.page(markdown_of(table));
    for (const auto& [phase, seconds] : table.phases) report.data(phase + "_seconds", seconds);
    report.data("peak_memory_bytes", table.peak_bytes);
}

} // namespace

Command lod_report_command() {
    return {
        "lod-report", "Measures the errors of the levels of detail of a .vdb, for several methods.",
        joined({
            grouped("Input and output",
                    {
                        {"FILE", "", "", any_text(), "", "A .vdb with levels of detail.", true},
                        {"--plot", "OUT.svg", "", any_text(), "",
                         "Writes a plot of the errors by level, with one line per method."},
                    }),
            grouped(
                "Methods",
                {
                    {"--methods", "A,B,...", "moments,single,naive,random,interpolate", any_text(),
                     "",
                     "Methods to build and measure levels with; wasserstein is available too, but slow."},
                    {"--lobes", "K", "(as in the file)", integer(1, 8), "",
                     "Maximum number of orientation lobes per voxel of the built levels."},
                }),
            grouped(
                "Effort",
                {
                    {"--parents", "N", "2000", integer(1, 1000000), "voxels per level",
                     "Maximum number of voxels that are compared with all finest voxels below them."},
                    {"--part", "N", "(all; 50000 with wasserstein)",
                     integer(1, std::int64_t{1} << 40), "voxels of the finest level",
                     "Builds and measures only some blocks, chosen by --seed, with about this many voxels."},
                }),
        }),
        run_lod_report};
}

} // namespace heddle::cli
