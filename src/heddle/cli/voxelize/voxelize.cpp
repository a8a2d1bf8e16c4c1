#include <heddle/cli/voxelize/voxelize.h>

#include <heddle/cli/rows/geometry_rows.h>
#include <heddle/cli/rows/level_rows.h>
#include <heddle/cli/rows/resolution_rows.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/voxelize/frames.h>
#include <heddle/cli/voxelize/report_voxelize.h>
#include <heddle/cli/voxelize/vol.h>
#include <heddle/cli/voxelize/voxelize_options.h>
#include <heddle/job/voxelize/voxelize_vol.h>

#include <limits>

namespace heddle::cli {
namespace {

void voxelize_frames(const Arguments& arguments, Report& report, ProgressBar& bar) {
    if (job::is_vol_file(arguments.text("FILE"))) {
        throw UsageError("--frames cannot be used with a .vol; it needs curves or meshes");
    }
    reject_vol_rows(arguments);
    const std::vector<job::AnimationFrame> frames = frames_from(arguments);
    const job::GeometryOptions geometry = geometry_options_from(arguments);
    const job::VoxelizeJobOptions options = voxelize_options_from(arguments);
    report_frames(report, frames,
                  arguments.given("dry-run")
                      ? job::plan_frames(frames, geometry, options, bar)
                      : job::voxelize_frames(frames, geometry, options, bar));
}

void run_voxelize(const Arguments& arguments, Report& report, ProgressBar& bar) {
    const std::string& path = arguments.text("FILE");
    if (arguments.given("frames")) return voxelize_frames(arguments, report, bar);
    if (job::is_vol_file(path)) return voxelize_vol(arguments, report, bar);
    reject_vol_rows(arguments);
    job::GeometryInput input{.path = path, .options = geometry_options_from(arguments)};
    const job::VoxelizeJobOptions options = voxelize_options_from(arguments);
    const std::string& output = arguments.text("output");
    report_voxelize(report,
                    arguments.given("dry-run")
                        ? job::plan_voxelize(std::move(input), options, bar)
                        : job::voxelize_to_file(std::move(input), output, options, bar),
                    output);
}

} // namespace

Command voxelize_command() {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    return {
        "voxelize", "Makes a .vdb with orientation and coverage from curves, meshes or volumes.",
        joined({
            grouped(
                "Input and output",
                {
                    {"FILE", "", "", any_text(), "",
                     "Curves (.bcc .hair .data .pyp), meshes (.obj .ply .gltf .glb) or a volume (.vol).",
                     true},
                    {"-o, --output", "OUT.vdb", "", any_text(), "", "Output volume.", true},
                    {"--dry-run", "", "", flag(), "", "Prints the plan and writes nothing."},
                }),
            frame_rows(),
            resolution_rows(),
            grouped(
                "Resolution",
                {
                    {"--fill-memory", "", "", flag(), "",
                     "Uses as many voxels as fit without a temporary file into --memory or half of the free memory."},
                    {"--bounds", "X0,Y0,Z0,X1,Y1,Z1", "(the whole object)",
                     numbers(6, 6, -kInf, kInf), "scene units",
                     "Keeps only the voxels that this box touches."},
                }),
            load_rows(),
            model_rows(),
            level_rows(),
            grouped(
                "Voxel contents",
                {
                    {"--lobes", "K", "3", integer(1, 8), "",
                     "Maximum number of orientation lobes per voxel."},
                    {"--footprints", "N",
                     "(4 if there are only curves, else 0; 0 with --lod naive)",
                     one_of({"0", "4", "8"}), "cells per axis",
                     "Stores which cells of a voxel's faces are covered. 0 = none."},
                    {"--occupancy", "N", "4", one_of({"0", "4"}), "cells per axis",
                     "Stores which of 4 x 4 x 4 cells of a voxel contain geometry. 0 = none."},
                    {"--correlation", "", "", flag(), "",
                     "Stores, per voxel face, how much the occlusion of the two neighbours overlaps (1 byte); makes --transport cells more accurate."},
                    {"--keep-masks", "", "", flag(), "",
                     "Stores columns and sums, from which 'heddle lod' rebuilds the levels bit for bit."},
                }),
            grouped("Memory and device",
                    {
                        {"--memory", "BYTES", "(half of the free memory)", bytes(),
                         "bytes; suffix K, M, G or T",
                         "Limit of the peak memory; a temporary file holds what does not fit."},
                    }),
            device_rows(),
            grouped(
                "Accuracy",
                {
                    {"--subvoxels", "N", "8", one_of({"1", "2", "4", "8"}), "per voxel axis",
                     "Subvoxels at which coverage is measured."},
                    {"--coverage", "MODE", "columns", one_of({"columns", "mask"}), "",
                     "columns: by rays through the centres of subvoxel columns; mask: by sampled subvoxels, as [Fabre26]."},
                    {"--samples", "N", "0", integer(0, 1'000'000), "per span",
                     "Number of samples, with --coverage mask only; 0 = two per subvoxel."},
                    {"--fit", "MODE", "moments", one_of({"moments", "last"}), "",
                     "moments: fits lobes to all directions; last: keeps the direction of one sample, as earlier voxelizers do."},
                }),
            raster_rows(),
            vol_rows(),
        }),
        run_voxelize};
}

} // namespace heddle::cli
