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
        throw UsageError(str("--", option, " is of no use here: ", need));
    }
}

} // namespace

std::vector<Option> load_options() {
    return {
        {"--yarn-radius", "R", "(what the file says, or half the distance of neighbouring yarns)",
         positive(), "scene units", "radius of the yarn or hair"},
        {"--repeat", "NX,NY", "1,1", numbers(2, 2, 1, 10000), "tiles",
         "how often a .pyp pattern is repeated"},
    };
}

std::vector<Option> model_options() {
    return {
        {"--yarn", "PRESET|FILE", "(each curve is one solid round fiber)", any_text(), "",
         str("yarn model: ", preset_names(), "; or a .toml, or Zhao 2016 fits in .txt")},
        {"--fibers", "N", "(what the model says)", integer(1, 1'000'000), "",
         "fibers in all of a yarn"},
        {"--fiber-radius", "R", "(what the model says, or the yarn's radius where solid)",
         positive(), "of the yarn model",
         "radius of a fiber; without --yarn: of each curve, in scene units"},
        {"--height-map", "IMAGE", "", any_text(), "",
         "displaces every mesh along its normals; needs uv"},
        {"--height-scale", "S", "1", number(-kInf, kInf), "scene units", "displacement of white"},
        {"--height-offset", "O", "0", number(-kInf, kInf), "scene units", "displacement of black"},
    };
}

Geometry load_geometry(const std::string& path, const Arguments& arguments) {
    return read_geometry(path, read_options(arguments));
}

void apply_model(Geometry& geometry, const Arguments& arguments) {
    const bool curves = !geometry.curves.empty();
    for (const char* option : {"yarn", "fiber-radius", "yarn-radius"}) {
        refuse_without(arguments, option, curves, "the file holds no curves");
    }
    refuse_without(arguments, "fibers", arguments.given("yarn"), "it needs --yarn");
    for (const char* option : {"height-scale", "height-offset"}) {
        refuse_without(arguments, option, arguments.given("height-map"), "it needs --height-map");
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
        throw Error(ErrorCode::CannotWrite, "it is a folder or a device, not a file",
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
