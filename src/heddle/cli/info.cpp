#include <heddle/cli/commands.h>
#include <heddle/cli/info_parts.h>
#include <heddle/cli/rows/geometry_rows.h>
#include <heddle/cli/rows/report_parts.h>
#include <heddle/cli/rows/resolution_rows.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/job/inspect_file.h>

#include <variant>

namespace heddle::cli {
namespace {

void run_info(const Arguments& arguments, Report& report, ProgressBar& bar) {
    const job::InspectOptions options{.geometry = geometry_options_from(arguments),
                                      .voxel_size = voxel_size_from(arguments),
                                      .voxels = arguments.find_integer("voxels")};
    const job::FileInfo info = job::inspect_file(arguments.text("FILE"), options, bar);
    report.text("file", info.file);
    if (const auto* volume = std::get_if<job::VolumeInfo>(&info.content)) {
        report_volume(report, *volume);
    } else if (const auto* layout = std::get_if<VolLayout>(&info.content)) {
        report_vol(report, *layout);
    } else {
        report_geometry(report, std::get<job::GeometryInfo>(info.content));
    }
    report.bytes("file size", info.file_bytes);
}

} // namespace

Command info_command() {
    return {"info", "Shows what a file contains and what voxelizing it would need.",
            joined({grouped("Input",
                            {{"FILE", "", "", any_text(), "",
                              "Any file that voxelize reads, or a .vdb written by heddle.", true}}),
                    resolution_rows(), load_rows(), model_rows()}),
            run_info};
}

} // namespace heddle::cli
