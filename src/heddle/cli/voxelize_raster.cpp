#include <heddle/base/error.h>
#include <heddle/cli/terminal/text.h>
#include <heddle/cli/voxelize_raster.h>
#include <heddle/raster/voxelize_slices.h>
#include <heddle/yarn/slice_image.h>

#include <algorithm>
#include <cstddef>
#include <string>

namespace heddle::cli {
namespace {

const std::vector<std::string>& composition_names() {
    static const std::vector<std::string> names{"last", "average", "max", "accumulate"};
    return names; // in the order of raster::Composition
}

const std::vector<std::string>& path_names() {
    static const std::vector<std::string> names{"auto", "fragment", "compute"};
    return names; // in the order of raster::RasterPath
}

/// Which of the names an option was given.
std::ptrdiff_t
choice(const Arguments& arguments, const char* option, const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), arguments.text(option)) - names.begin();
}

void report_counts(Report& report, const raster::RasterCounts& counts) {
    report.text("driver", counts.driver);
    report.text("raster path", path_names()[static_cast<std::size_t>(counts.path)]);
    report.count("slices", counts.slices);
    report.count("bricks", counts.bricks, "of 8^3 voxels, touched by slices");
    report.count("draw batches", counts.batches);
    const auto seconds = [&report](const char* key, const char* label, double value) {
        report.add(key, label, value, show_seconds(value));
    };
    seconds("slices_placed_seconds", "placing slices", counts.setup_seconds);
    seconds("three_passes_seconds", "drawing", counts.draw_seconds);
    seconds("sums_to_voxels_seconds", "fitting voxels", counts.fit_seconds);
}

} // namespace

std::vector<Option> raster_options() {
    return grouped(
        "OpenGL backend",
        {
            {"--backend", "NAME", "sample", one_of({"sample", "raster"}), "",
             "sample: fibers and triangles, on the CPU or a CUDA device; raster: slices of yarns and hair, drawn by OpenGL."},
            {"--composition", "POLICY", "accumulate", one_of(composition_names()), "",
             "accumulate: the coverage of the fibers themselves; last, average, max: one density per voxel from the alpha of its slices. Needs --backend raster."},
            {"--slice-spacing", "S", "(half of the yarn radius)", positive(), "scene units",
             "Maximum distance between slices. Needs --backend raster."},
            {"--raster-path", "PATH", "auto", one_of(path_names()), "",
             "Kind of shader that draws; the voxels are the same. auto: the faster one. Needs --backend raster."},
        });
}

raster::RasterOptions raster_options_from(const Arguments& arguments) {
    raster::RasterOptions options;
    options.composition =
        static_cast<raster::Composition>(choice(arguments, "composition", composition_names()));
    options.path = static_cast<raster::RasterPath>(choice(arguments, "raster-path", path_names()));
    if (arguments.given("slice-spacing")) {
        options.slice_spacing = arguments.number("slice-spacing");
    }
    return options;
}

bool uses_raster(const Arguments& arguments) {
    return arguments.text("backend") == "raster";
}

void prepare_backend(Geometry& geometry, const Arguments& arguments) {
    if (!uses_raster(arguments)) {
        for (const char* option : {"composition", "slice-spacing", "raster-path"}) {
            if (!arguments.given(option)) continue;
            throw UsageError(str("--", option, " needs --backend raster"));
        }
        return;
    }
    if (arguments.text("device") == "cuda") {
        throw UsageError("--device cuda cannot be used with --backend raster");
    }
    if (arguments.given("device-memory")) {
        throw UsageError("--device-memory cannot be used with --backend raster");
    }
    if (arguments.text("fit") == "last") {
        throw UsageError("--fit last cannot be used with --backend raster");
    }
    for (std::string& note :
         make_slices_of_yarns(geometry, static_cast<std::uint64_t>(arguments.integer("seed")))) {
        geometry.notes.push_back(std::move(note));
    }
}

std::unique_ptr<VoxelSource> voxelize_raster(const Geometry& geometry,
                                             const VoxelizeOptions& options,
                                             const VoxelizePlan& plan,
                                             raster::SliceVoxelizer& drawer,
                                             Progress& progress,
                                             BlockVisitor* visitor,
                                             Report& report) {
    raster::RasterCounts counts;
    std::unique_ptr<VoxelSource> grid =
        drawer.voxelize(geometry, options, plan, progress, visitor, &counts);
    report_counts(report, counts);
    return grid;
}

} // namespace heddle::cli
