#include <heddle/base/error.h>
#include <heddle/cli/terminal/text.h>
#include <heddle/cli/voxel_options.h>
#include <heddle/io/vdb/predict_vdb.h>

#include <limits>

namespace heddle::cli {

std::vector<Option> resolution_options() {
    return grouped(
        "Resolution",
        {
            {"--voxels", "N", "512", integer(1, std::int64_t{1} << 30), "voxels",
             "Number of voxels along the longest axis."},
            {"--voxel-size", "X[,Y,Z]", "(from --voxels)",
             numbers(1, 3, 0.0, std::numeric_limits<double>::infinity(), ',', true), "scene units",
             "Edge length of a voxel; three numbers for voxels that are not cubes."},
        });
}

VoxelizeOptions resolution_from(const Arguments& arguments) {
    VoxelizeOptions options;
    options.voxels = arguments.integer("voxels");
    options.writer_bytes = kVdbWriterBytes;
    options.writer_bytes_per_leaf = kVdbWriterBytesPerLeaf;
    if (!arguments.given("voxel-size")) return options;
    if (arguments.given("voxels")) {
        throw UsageError("--voxel-size and --voxels both set the resolution; give one of them");
    }
    const std::vector<double> size = arguments.numbers("voxel-size");
    const bool cube = size.size() == 1;
    options.voxel_size = {size[0], cube ? size[0] : size[1], cube ? size[0] : size[2]};
    return options;
}

std::int64_t report_work(Report& report, const VoxelizePlan& plan) {
    report.count("primitives", plan.primitives, "spans and triangles");
    report.add("steps", "steps", plan.steps,
               str(show_count(plan.steps), " (fiber length in subvoxel edges)"));
    report.count("predicted voxels", plan.voxels);
    report.count("predicted touched subvoxels", plan.touched_subvoxels);
    std::vector<LevelSize> levels{{plan.leaves, plan.voxels, plan.lobes}};
    levels.insert(levels.end(), plan.levels.begin(), plan.levels.end());
    const auto file = static_cast<std::int64_t>(predict_vdb_bytes(levels, plan.fields).file);
    report.bytes("predicted file size", file);
    report.bytes("predicted peak memory", plan.peak_bytes);
    if (plan.seconds > 0.0) report.seconds("predicted time", plan.seconds);
    return file;
}

} // namespace heddle::cli
