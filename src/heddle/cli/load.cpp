#include <heddle/base/error.h>
#include <heddle/cli/load.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/file/output_file.h>
#include <heddle/io/geometry/apply_yarn.h>
#include <heddle/io/geometry/read_geometry.h>
#include <heddle/io/image/image.h>
#include <heddle/io/mesh/read_mesh.h>
#include <heddle/io/yarn/yarn_file.h>

#include <filesystem>
#include <limits>
#include <utility>

namespace heddle::cli {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

CurveReadOptions read_options(const Arguments& arguments) {
    CurveReadOptions options;
    if (arguments.given("yarn-radius")) {
        options.radius = static_cast<float>(arguments.number("yarn-radius"));
    }
    const std::vector<double> repeat = arguments.numbers("repeat");
    options.repeat_x = static_cast<int>(repeat[0]);
    options.repeat_y = static_cast<int>(repeat[1]);
    return options;
}

/// "cotton, silk, wool".
std::string preset_names() {
    std::string names;
    for (const std::string& name : list_presets()) names += (names.empty() ? "" : ", ") + name;
    return names;
}

/// The rows that say what the curves become. All of them are above 0 where they are given.
YarnOptions yarn_options(const Arguments& arguments) {
    YarnOptions options;
    if (arguments.given("yarn")) options.yarn = arguments.text("yarn");
    if (arguments.given("fibers")) options.fibers = arguments.integer("fibers");
    for (const auto& [name, out] : {std::pair{"yarn-radius", &options.yarn_radius},
                                    std::pair{"fiber-radius", &options.fiber_radius}}) {
        if (arguments.given(name)) *out = static_cast<float>(arguments.number(name));
    }
    return options;
}

void refuse_without(const Arguments& arguments, const char* option, bool usable, const char* need) {
    if (arguments.given(option) && !usable) {
        throw UsageError(str("--", option, " needs ", need));
    }
}

} // namespace

std::vector<Option> load_options() {
    return grouped(
        "Yarn and hair",
        {
            {"--yarn-radius", "R", "(from the file, or half the distance of neighbouring yarns)",
             positive(), "scene units", "Radius of the yarn or hair."},
            {"--repeat", "NX,NY", "1,1", numbers(2, 2, 1, 10000), "tiles",
             "Number of repetitions of a periodic .pyp pattern."},
        });
}

std::vector<Option> model_options() {
    return joined({
        grouped(
            "Yarn and hair",
            {
                {"--yarn", "PRESET|FILE", "(each curve is one solid round fiber)", any_text(), "",
                 str("Yarn model: ", preset_names(),
                     ", a .toml file, or a .txt file of fits after Zhao et al. 2016.")},
                {"--fibers", "N", "(from the yarn model)", integer(1, 1'000'000), "",
                 "Number of fibers in a yarn, over all plies; needs --yarn."},
                {"--fiber-radius", "R", "(from the yarn model, or the yarn radius without --yarn)",
                 positive(), "yarn model units",
                 "Radius of a fiber; without --yarn, the radius of each curve in scene units."},
            }),
        grouped(
            "Height map of meshes",
            {
                {"--height-map", "IMAGE", "", any_text(), "",
                 "Displaces all meshes along their normals by this image; needs texture coordinates."},
                {"--height-scale", "S", "1", number(-kInf, kInf), "scene units",
                 "Displacement of white, in addition to that of black."},
                {"--height-offset", "O", "0", number(-kInf, kInf), "scene units",
                 "Displacement of black."},
            }),
    });
}

Geometry load_geometry(const std::string& path, const Arguments& arguments) {
    return read_geometry(path, read_options(arguments));
}

void apply_model(Geometry& geometry, const Arguments& arguments) {
    const bool curves = !geometry.curves.empty();
    for (const char* option : {"yarn", "fiber-radius", "yarn-radius"}) {
        refuse_without(arguments, option, curves, "curves, but the file holds none");
    }
    refuse_without(arguments, "fibers", arguments.given("yarn"), "--yarn");
    for (const char* option : {"height-scale", "height-offset"}) {
        refuse_without(arguments, option, arguments.given("height-map"), "--height-map");
    }
    apply_yarn(geometry, yarn_options(arguments));
    if (arguments.given("height-map")) {
        set_height_map(geometry, read_image(arguments.text("height-map")),
                       static_cast<float>(arguments.number("height-scale")),
                       static_cast<float>(arguments.number("height-offset")));
    }
}

void check_output(const std::string& path, const std::string& suffix, const std::string& option) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    // OutputFile would write to a device, but a .vdb needs seeks: said before the work starts
    if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
        throw Error(ErrorCode::CannotWrite, "this is a folder or a device, not a file",
                    "write to another place", {.path = path});
    }
    if (suffix_of(path) != suffix) {
        throw UsageError(str(option, ": '", path, "' must end in ", suffix));
    }
    write_output([&path] { const OutputFile probe(path); });
}

void write_output(const std::function<void()>& write) {
    try {
        write();
    } catch (const Error& e) {
        switch (e.code()) {
        case ErrorCode::Cancelled:
        case ErrorCode::OutOfMemory:
        case ErrorCode::Internal: throw;
        default: throw Error(ErrorCode::CannotWrite, e.what());
        }
    }
}

} // namespace heddle::cli
