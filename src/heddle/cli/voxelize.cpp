#include <heddle/cli/commands.h>
#include <heddle/cli/device_options.h>
#include <heddle/cli/frames.h>
#include <heddle/cli/level_options.h>
#include <heddle/cli/load.h>
#include <heddle/cli/voxel_options.h>
#include <heddle/cli/voxelize_file.h>
#include <heddle/cli/voxelize_frames.h>
#include <heddle/cli/voxelize_raster.h>
#include <heddle/cli/voxelize_vol.h>

#include <limits>

namespace heddle::cli {
namespace {

void run_voxelize(const Arguments& arguments, Report& report, ProgressBar& bar) {
    if (arguments.given("frames")) return voxelize_frames(arguments, report, bar);
    if (is_volume(arguments)) return voxelize_volume(arguments, report, bar);
    refuse_volume_options(arguments);
    const std::string output = arguments.text("output");
    if (!arguments.given("dry-run")) check_output(output, ".vdb");
    raster::SliceVoxelizer drawer(raster_options_from(arguments));
    (void)voxelize_file(arguments, arguments.text("FILE"), output, drawer, report, bar);
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
            frame_options(),
            resolution_options(),
            grouped(
                "Resolution",
                {
                    {"--fill-memory", "", "", flag(), "",
                     "Uses as many voxels as fit without a temporary file into --memory or half of the free memory."},
                    {"--bounds", "X0,Y0,Z0,X1,Y1,Z1", "(the whole object)",
                     numbers(6, 6, -kInf, kInf), "scene units",
                     "Keeps only the voxels that this box touches."},
                }),
            load_options(),
            model_options(),
            level_options(),
            grouped(
                "Voxel contents",
                {
                    {"--lobes", "K", "3", integer(1, 8), "",
                     "Maximum number of orientation lobes per voxel."},
                    {"--footprints", "N",
                     "(4 if there are only curves, else 0; 0 with --lod naive)",
                     one_of({"0", "4", "8"}), "cells per axis",
                     "Stores which cells of a voxel's faces are covered; used by --transport footprint. 0 = none."},
                    {"--correlation", "", "", flag(), "",
                     "Stores, per voxel face, how much the occlusion of the two neighbours overlaps (1 byte); used by --transport threshold."},
                    {"--keep-masks", "", "", flag(), "",
                     "Stores columns and sums, from which 'heddle lod' rebuilds the levels bit for bit."},
                }),
            grouped("Memory and device",
                    {
                        {"--memory", "BYTES", "(half of the free memory)", bytes(),
                         "bytes; suffix K, M, G or T",
                         "Limit of the peak memory; a temporary file holds what does not fit."},
                    }),
            device_options(),
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
            raster_options(),
            volume_options(),
        }),
        run_voxelize};
}

} // namespace heddle::cli
