#include <heddle/cli/rows/resolution_rows.h>

#include <limits>

namespace heddle::cli {

std::vector<Option> resolution_rows() {
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

std::optional<Vec3d> voxel_size_from(const Arguments& arguments) {
    if (!arguments.given("voxel-size")) return std::nullopt;
    const std::vector<double> size = arguments.numbers("voxel-size");
    const bool cube = size.size() == 1;
    return Vec3d{size[0], cube ? size[0] : size[1], cube ? size[0] : size[2]};
}

} // namespace heddle::cli
