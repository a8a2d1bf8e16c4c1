#include <heddle/base/error.h>
#include <heddle/cli/load.h>
#include <heddle/cli/view_options.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <numbers>
#include <utility>

namespace heddle::cli {
namespace {

Vec3d direction(const Arguments& arguments, const char* name) {
    const std::vector<double> v = arguments.numbers(name);
    return {v[0], v[1], v[2]};
}

/// Colours of slices, then of voxels, each in the order of its enumeration.
const std::vector<std::string>& slice_colors() {
    static const std::vector<std::string> names{"shaded", "direction", "grid"};
    return names;
}
const std::vector<std::string>& voxel_colors() {
    static const std::vector<std::string> names{"shaded",   "density", "tangent", "width",
                                                "material", "block",   "level"};
    return names;
}

/// Place of `name` in `names`, which has it.
template <typename Color>
Color color_of(const std::vector<std::string>& names, const std::string& name) {
    return static_cast<Color>(std::find(names.begin(), names.end(), name) - names.begin());
}

bool shows_voxels(const Arguments& arguments) {
    return is_volume_file(arguments) || arguments.text("show") == "voxels";
}

viewer::SliceLook slice_look(const Arguments& arguments) {
    const std::string blend = arguments.text("blend");
    viewer::SliceLook look;
    look.light = direction(arguments, "light");
    look.sorted = blend != "placed";
    look.weighted = blend == "weighted";
    look.shadows = !arguments.given("no-shadows");
    look.occlusion = !arguments.given("no-occlusion");
    look.opacity = arguments.number("opacity");
    return look;
}

viewer::VoxelLook voxel_look(const Arguments& arguments) {
    viewer::VoxelLook look;
    look.shadows = !arguments.given("no-shadows");
    if (arguments.given("level")) look.level = static_cast<int>(arguments.integer("level"));
    look.density_scale = arguments.number("opacity");
    look.blocks = arguments.given("blocks");
    if (arguments.given("white-block")) {
        const std::vector<double> b = arguments.numbers("white-block");
        look.white_block = Vec3i{static_cast<std::int32_t>(b[0]), static_cast<std::int32_t>(b[1]),
                                 static_cast<std::int32_t>(b[2])};
    }
    return look;
}

Vec3d axis_of(const std::string& name) {
    return {name == "x" ? 1.0 : 0.0, name == "y" ? 1.0 : 0.0, name == "z" ? 1.0 : 0.0};
}

/// The axis that was asked for, or as preview has it: z of what lies flat.
Vec3d up_of(const Arguments& arguments, const viewer::Subject& subject) {
    const std::string name = arguments.text("up");
    if (name != "auto") return axis_of(name);
    const Vec3d size = viewer::bounds_of(subject).size();
    return axis_of(size.z < 0.5 * size.x && size.z < 0.5 * size.y ? "z" : "y");
}

/// About the unit ball.
viewer::Orbit orbit_of(const Arguments& arguments, const viewer::Subject& subject, double aspect) {
    constexpr double kDegree = std::numbers::pi / 180.0;
    viewer::Orbit orbit{.from = direction(arguments, "from"),
                        .up = up_of(arguments, subject),
                        .view_angle = arguments.number("view-angle") * kDegree};
    orbit.frame({.radius = 1.0}, aspect);
    if (arguments.given("target")) orbit.target = direction(arguments, "target");
    orbit.zoom(arguments.number("zoom"));
    return orbit;
}

} // namespace

bool is_volume_file(const Arguments& arguments) {
    return std::filesystem::path(arguments.text("FILE")).extension() == ".vdb";
}

void check_view(const Arguments& arguments) {
    const bool headless = arguments.given("headless");
    const bool volume = is_volume_file(arguments) || arguments.given("volume");
    const std::string color = arguments.text("color");
    if (headless && !arguments.given("output")) {
        throw UsageError("--headless needs a folder for the pictures; give -o DIR");
    }
    for (const char* option : {"frames", "scene"}) {
        if (headless || !arguments.given(option)) continue;
        throw UsageError(str("--", option, " needs --headless"));
    }
    if (arguments.given("volume") && is_volume_file(arguments)) {
        throw UsageError(
            "--volume cannot be used with a .vdb as FILE; it shows voxels beside curves");
    }
    if (!volume && (arguments.given("scene") || shows_voxels(arguments) || color == "grid")) {
        throw UsageError("there are no voxels to show; open a .vdb, or give --volume X.vdb");
    }
    const std::vector<std::string>& colors =
        shows_voxels(arguments) ? voxel_colors() : slice_colors();
    if (std::find(colors.begin(), colors.end(), color) == colors.end()) {
        throw UsageError(str("--color ", color, " is not available for ",
                             shows_voxels(arguments) ? "voxels" : "slices",
                             "; see heddle view --help"));
    }
}

viewer::Settings view_settings(const Arguments& arguments, const viewer::Subject& subject) {
    const std::vector<double> size = arguments.numbers("size", 'x');
    viewer::Settings out;
    out.orbit = orbit_of(arguments, subject, size[0] / size[1]);
    out.target_given = arguments.given("target");
    out.framed = true;
    out.slices = slice_look(arguments);
    out.volume = voxel_look(arguments);
    out.show = shows_voxels(arguments) ? viewer::Show::Voxels : viewer::Show::Slices;
    const std::string color = arguments.text("color");
    if (shows_voxels(arguments))
        out.volume.color = color_of<viewer::VoxelColor>(voxel_colors(), color);
    else
        out.slices.color = color_of<viewer::SliceColor>(slice_colors(), color);
    return out;
}

std::vector<Option> view_options() {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    std::vector<Option> yarn = joined({load_options(), model_options()});
    std::erase_if(yarn, [](const Option& row) { return row.key().starts_with("height-"); });
    return joined({
        grouped(
            "Input and output",
            {
                {"FILE", "", "", any_text(), "",
                 "Curves (.bcc .hair .data .pyp) or a .vdb written by heddle.", true},
                {"--volume", "X.vdb", "", any_text(), "",
                 "A volume to show beside the curves of FILE."},
                {"-o, --output", "DIR", "(the current folder)", any_text(), "",
                 "Folder for saved files; required with --headless, which writes frame_0000.png and so on."},
            }),
        grouped(
            "Without a window",
            {
                {"--headless", "", "", flag(), "",
                 "Writes pictures instead of opening a window; needs no display."},
                {"--frames", "N", "1", integer(1, 10000), "pictures",
                 "Number of pictures, once around the object; needs --headless."},
                {"--scene", "", "", flag(), "",
                 "Also writes a scene for render with the first picture's camera and light; needs --headless."},
            }),
        grouped(
            "Camera",
            {
                {"--size", "WxH", "960x960", numbers(2, 2, 1, 8192, 'x'), "pixels",
                 "Size of the window or of a picture."},
                {"--from", "X,Y,Z", "0.3,-0.6,1", numbers(3, 3, -kInf, kInf), "any length",
                 "Direction from the object to the camera, in the first picture."},
                {"--up", "AXIS", "auto", one_of({"auto", "x", "y", "z"}), "",
                 "Axis that points up and that the pictures turn around; auto: z for a flat object, else y."},
                {"--target", "X,Y,Z", "(the centre of the object)", numbers(3, 3, -kInf, kInf),
                 "scene units", "Point in the middle of the picture."},
                {"--zoom", "Z", "1", positive(), "",
                 "Magnification; at 1 the whole object fits from any side."},
                {"--view-angle", "A", "35", number(0, 170), "degrees",
                 "Field of view across the picture's height; 0 = parallel projection."},
            }),
        grouped(
            "Look",
            {
                {"--show", "WHAT", "slices", one_of({"slices", "voxels"}), "",
                 "What to show of curves with --volume; a .vdb alone is shown as voxels."},
                {"--color", "MODE", "shaded",
                 one_of({"shaded", "direction", "grid", "density", "tangent", "width", "material",
                         "block", "level"}),
                 "",
                 "Slices: shaded, direction (x^2, y^2, z^2 of the fiber direction as red, green, blue) or grid (the same of the direction stored in the voxels). Voxels: all modes but direction and grid."},
                {"--light", "X,Y,Z", "-0.5,0.6,1", numbers(3, 3, -kInf, kInf), "any length",
                 "Direction from the object to the light."},
                {"--opacity", "K", "1", positive(), "",
                 "Multiplies the density of slices and voxels."},
                {"--no-shadows", "", "", flag(), "", "Draws without shadows."},
                {"--no-occlusion", "", "", flag(), "",
                 "Draws slices without the occlusion between fibers of the same cross-section."},
            }),
        std::move(yarn),
        grouped(
            "Levels and blocks",
            {
                {"--level", "N", "(from the width of each pixel)", integer(0, 1000), "",
                 "Level of detail of voxels; 0 = the finest."},
                {"--blocks", "", "", flag(), "",
                 "Draws the edges of occupied blocks of 32^3 voxels."},
                {"--white-block", "X,Y,Z", "", numbers(3, 3, -1e6, 1e6), "blocks",
                 "Shows this block in white, voxel by voxel; slices show it with --color grid only."},
            }),
        grouped(
            "Blending and memory",
            {
                {"--blend", "MODE", "sorted", one_of({"sorted", "weighted", "placed"}), "",
                 "Draw order of slices. sorted: by depth; weighted: independent of order, also used if slices exceed --memory; placed: unsorted, for comparison."},
                {"--memory", "BYTES", "(size of the driver's largest buffer)", bytes(),
                 "bytes; suffix K, M, G or T",
                 "Limit of the memory for visible slices and their order."},
            }),
    });
}

} // namespace heddle::cli
