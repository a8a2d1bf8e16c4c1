#include <heddle/cli/voxelize/voxelize_options.h>

#include <heddle/cli/rows/level_rows.h>
#include <heddle/cli/rows/resolution_rows.h>

#include <algorithm>
#include <cstddef>
#include <string>

namespace heddle::cli {
namespace {

const std::vector<std::string>& composition_names() {
    static const std::vector<std::string> names{"last", "average", "max", "accumulate"};
    return names; // in the order of raster::Composition
}

/// Returns the index of the value of an option in a list of names.
std::ptrdiff_t
choice(const Arguments& arguments, const char* option, const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), arguments.text(option)) - names.begin();
}

void read_backend(const Arguments& arguments, job::VoxelizeJobOptions& options) {
    if (arguments.text("backend") == "raster") options.backend = job::Backend::Raster;
    if (arguments.given("composition")) {
        options.composition =
            static_cast<raster::Composition>(choice(arguments, "composition", composition_names()));
    }
    options.slice_spacing = arguments.find_number("slice-spacing");
    if (arguments.given("raster-path")) {
        options.raster_path =
            static_cast<raster::RasterPath>(choice(arguments, "raster-path", path_names()));
    }
    const std::string& device = arguments.text("device");
    if (device == "cpu") options.device = job::DeviceChoice::Cpu;
    if (device == "cuda") options.device = job::DeviceChoice::Cuda;
    options.device_memory_bytes = arguments.find_bytes("device-memory");
}

} // namespace

const std::vector<std::string>& path_names() {
    static const std::vector<std::string> names{"auto", "fragment", "compute"};
    return names; // in the order of raster::RasterPath
}

std::vector<Option> raster_rows() {
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

std::vector<Option> device_rows() {
    return grouped(
        "Memory and device",
        {
            {"--device", "WHERE", "auto", one_of({"cpu", "cuda", "auto"}), "",
             "Where voxels are computed; the result is the same. auto: CUDA if a GPU is present and supports the options, else the CPU."},
            {"--device-memory", "BYTES", "(9/10 of the free device memory)", bytes(),
             "bytes; suffix K, M, G or T", "Limit of the memory used on the CUDA device."},
        });
}

job::VoxelizeJobOptions voxelize_options_from(const Arguments& arguments) {
    job::VoxelizeJobOptions options;
    options.voxel_size = voxel_size_from(arguments);
    options.voxels = arguments.find_integer("voxels");
    options.fill_memory = arguments.given("fill-memory");
    if (arguments.given("bounds")) {
        const std::vector<double> b = arguments.numbers("bounds");
        options.bounds = Bounds{{b[0], b[1], b[2]}, {b[3], b[4], b[5]}};
    }
    options.lobes = static_cast<std::int32_t>(arguments.integer("lobes"));
    options.subvoxels = static_cast<std::int32_t>(arguments.integer("subvoxels"));
    if (arguments.text("coverage") == "mask") options.coverage = CoverageMode::Mask;
    options.samples = arguments.integer("samples");
    if (arguments.text("fit") == "last") options.fit = FitMode::Last;
    if (arguments.given("footprints")) {
        options.footprints = static_cast<std::int32_t>(arguments.integer("footprints"));
    }
    options.occupancy = arguments.integer("occupancy") != 0;
    options.correlation = arguments.given("correlation");
    options.keep_masks = arguments.given("keep-masks");
    options.lod = lod_method_from(arguments);
    options.levels = level_count_from(arguments);
    options.seed = static_cast<std::uint64_t>(arguments.integer("seed"));
    options.memory_bytes = arguments.find_bytes("memory");
    options.command = arguments.command_line;
    read_backend(arguments, options);
    return options;
}

} // namespace heddle::cli
