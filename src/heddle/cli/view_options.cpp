#include <heddle/base/error.h>
#include <heddle/cli/load.h>
#include <heddle/cli/view_options.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <numbers>

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
        throw UsageError("--headless needs a folder for its pictures: -o DIR");
    }
    for (const char* option : {"frames", "scene"}) {
        if (headless || !arguments.given(option)) continue;
        throw UsageError(str("--", option, " is of no use here: it needs --headless"));
    }
    if (arguments.given("volume") && is_volume_file(arguments)) {
        throw UsageError("--volume is of no use here: it needs curves to be shown with");
    }
    if (!volume && (arguments.given("scene") || shows_voxels(arguments) || color == "grid")) {
        throw UsageError("no voxels are there to be shown: open a .vdb, or give --volume X.vdb");
    }
    const std::vector<std::string>& colors =
        shows_voxels(arguments) ? voxel_colors() : slice_colors();
    if (std::find(colors.begin(), colors.end(), color) == colors.end()) {
        throw UsageError(str("--color ", color, " is none of ",
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
    std::vector<Option> options{
        {"FILE", "", "", any_text(), "", "curves: .bcc .hair .data .pyp; or a .vdb of ours", true},
        {"--volume", "X.vdb", "", any_text(), "", "voxels to be shown beside curves"},
        {"-o, --output", "DIR", "(here)", any_text(), "",
         "where the window saves; with --headless: folder of the pictures, frame_0000.png on"},
        {"--headless", "", "", flag(), "", "pictures, without a window or a display"},
        {"--frames", "N", "1", integer(1, 10000), "pictures",
         "with --headless: once around the object"},
        {"--scene", "", "", flag(), "",
         "with --headless: a scene for render beside the pictures, with the first one's camera and "
         "light"},
    };
    for (const std::vector<Option>& more : {load_options(), model_options()}) {
        for (const Option& row : more) {
            if (row.key().rfind("height-", 0) != 0) options.push_back(row);
        }
    }
    const std::vector<Option> more{
        {"--from", "X,Y,Z", "0.3,-0.6,1", numbers(3, 3, -kInf, kInf), "any length",
         "direction from the object to the eye, of the first picture"},
        {"--up", "AXIS", "auto", one_of({"auto", "x", "y", "z"}), "",
         "points up in the picture; pictures go around it; auto: z of what lies flat, else y"},
        {"--light", "X,Y,Z", "-0.5,0.6,1", numbers(3, 3, -kInf, kInf), "any length",
         "direction from the object to the light"},
        {"--target", "X,Y,Z", "(the middle of all)", numbers(3, 3, -kInf, kInf), "scene units",
         "what is in the picture's middle"},
        {"--zoom", "Z", "1", positive(), "", "1 = all of the object, from any side"},
        {"--view-angle", "A", "35", number(0, 170), "degrees",
         "across the picture's height; 0 = parallel rays"},
        {"--size", "WxH", "960x960", numbers(2, 2, 1, 8192, 'x'), "pixels", "of a picture"},
        {"--show", "WHAT", "slices", one_of({"slices", "voxels"}), "",
         "of curves with --volume; a .vdb alone is shown as voxels"},
        {"--color", "MODE", "shaded",
         one_of({"shaded", "direction", "grid", "density", "tangent", "width", "material", "block",
                 "level"}),
         "",
         "of slices: shaded; direction: x^2, y^2, z^2 of the fiber's as red, green, blue; grid: of "
         "the direction that voxels store; of voxels: all but direction and grid"},
        {"--opacity", "K", "1", positive(), "", "multiplies how much slices and voxels hide"},
        {"--level", "N", "(by each pixel's width)", integer(0, 1000), "",
         "of voxels; 0 = the finest"},
        {"--blocks", "", "", flag(), "", "draws edges of occupied blocks of 32 voxels each way"},
        {"--white-block", "X,Y,Z", "", numbers(3, 3, -1e6, 1e6), "blocks",
         "shows this block in white, voxel by voxel; of slices with --color grid"},
        {"--blend", "MODE", "sorted", one_of({"sorted", "weighted", "placed"}), "",
         "weighted: no order shows, also taken where slices exceed --memory; placed: as they come, "
         "to compare"},
        {"--memory", "BYTES", "(what one buffer of the driver holds)", bytes(), "K, M, G",
         "of slices in view and their order"},
        {"--no-shadows", "", "", flag(), "", "leaves out the shadow map"},
        {"--no-occlusion", "", "", flag(), "", "leaves out what fibers hide in their section"},
    };
    options.insert(options.end(), more.begin(), more.end());
    return options;
}

} // namespace heddle::cli
