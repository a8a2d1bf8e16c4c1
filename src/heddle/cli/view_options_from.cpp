#include <heddle/cli/rows/geometry_rows.h>
#include <heddle/cli/view_rows.h>

namespace heddle::cli {
namespace {

Vec3d direction(const Arguments& arguments, const char* name) {
    const std::vector<double> v = arguments.numbers(name);
    return {v[0], v[1], v[2]};
}

job::SliceBlend blend_from(const std::string& name) {
    if (name == "weighted") return job::SliceBlend::Weighted;
    return name == "placed" ? job::SliceBlend::Placed : job::SliceBlend::Sorted;
}

} // namespace

job::ViewInput view_input_from(const Arguments& arguments) {
    job::ViewInput input;
    input.path = arguments.text("FILE");
    input.geometry = geometry_options_from(arguments);
    input.volume = arguments.find_text("volume");
    input.folder = arguments.find_text("output").value_or(".");
    input.seed = static_cast<std::uint64_t>(arguments.integer("seed"));
    input.memory_bytes = arguments.find_bytes("memory");
    return input;
}

job::ViewOptions view_options_from(const Arguments& arguments) {
    job::ViewOptions options;
    const std::vector<double> size = arguments.numbers("size", 'x');
    options.width = static_cast<std::int32_t>(size[0]);
    options.height = static_cast<std::int32_t>(size[1]);
    options.from = direction(arguments, "from");
    const std::string& up = arguments.text("up");
    if (up != "auto") options.up_axis = up.front() - 'x';
    options.light = direction(arguments, "light");
    if (arguments.given("target")) options.target = direction(arguments, "target");
    options.zoom = arguments.number("zoom");
    options.view_angle_deg = arguments.number("view-angle");
    if (arguments.text("show") == "voxels") options.show = viewer::Show::Voxels;
    options.color = arguments.text("color");
    options.opacity = arguments.number("opacity");
    if (arguments.given("level")) options.level = static_cast<int>(arguments.integer("level"));
    options.blocks = arguments.given("blocks");
    if (arguments.given("white-block")) {
        const std::vector<double> b = arguments.numbers("white-block");
        options.white_block =
            Vec3i{static_cast<std::int32_t>(b[0]), static_cast<std::int32_t>(b[1]),
                  static_cast<std::int32_t>(b[2])};
    }
    options.blend = blend_from(arguments.text("blend"));
    options.shadows = !arguments.given("no-shadows");
    options.occlusion = !arguments.given("no-occlusion");
    return options;
}

} // namespace heddle::cli
