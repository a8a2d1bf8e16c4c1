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
    std::vector<Option> options{
        {"FILE", "", "", any_text(), "",
         "curves: .bcc .hair .data .pyp; meshes: .obj .ply .gltf .glb; volumes: .vol", true},
        {"-o, --output", "OUT.vdb", "", any_text(), "", "where the volume goes", true},
    };
    const auto add = [&options](const std::vector<Option>& more) {
        options.insert(options.end(), more.begin(), more.end());
    };
    add(frame_options());
    add(resolution_options());
    add({{"--fill-memory", "", "", flag(), "",
          "as many voxels as fit into memory without a temporary file (--memory, else half of what "
          "is "
          "free)"}});
    add({{"--bounds", "X0,Y0,Z0,X1,Y1,Z1", "(all of the object)", numbers(6, 6, -kInf, kInf),
          "scene units", "keeps the voxels that touch this box"}});
    add(load_options());
    add(model_options());
    add(volume_options());
    add({
        {"--lobes", "K", "3", integer(1, 8), "", "most orientation lobes in a voxel"},
        {"--subvoxels", "N", "8", one_of({"1", "2", "4", "8"}), "per voxel axis",
         "how finely coverage is measured"},
        {"--coverage", "MODE", "columns", one_of({"columns", "mask"}), "",
         "columns: by centre rays; mask: by sampled subvoxels, as [Fabre26]"},
        {"--samples", "N", "0", integer(0, 1'000'000), "per span",
         "with --coverage mask; 0 = two a subvoxel"},
        {"--fit", "MODE", "moments", one_of({"moments", "last"}), "",
         "moments: all directions count; last: one sample's, as earlier voxelizers"},
    });
    add(raster_options());
    add(level_options());
    add({
        {"--footprints", "N", "(4 of yarn and hair, else 0)", one_of({"0", "4", "8"}),
         "cells per axis",
         "keeps which parts of a voxel's faces are covered, for transport; 0 = no"},
        {"--correlation", "", "", flag(), "",
         "keeps how far neighbouring voxels hide the same, for transport: a byte a face"},
        {"--keep-masks", "", "", flag(), "",
         "stores columns and sums: 'heddle lod' then builds the same levels again, bit for bit"},
        {"--memory", "BYTES", "(half of what is free)", bytes(), "K, M, G",
         "peak memory that is kept to"},
        {"--dry-run", "", "", flag(), "", "prints the plan and writes nothing"},
    });
    add(device_options());
    return {"voxelize", "a .vdb with orientations and coverage, from curves, meshes or volumes",
            options, run_voxelize};
}

} // namespace heddle::cli
