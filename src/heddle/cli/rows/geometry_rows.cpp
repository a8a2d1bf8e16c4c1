#include <heddle/cli/rows/geometry_rows.h>

#include <heddle/base/error.h>

#include <limits>
#include <string>

namespace heddle::cli {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

/// Returns a list such as "cotton, silk, wool".
std::string preset_names() {
    std::string names;
    for (const std::string& name : job::yarn_preset_names()) {
        names += (names.empty() ? "" : ", ") + name;
    }
    return names;
}

} // namespace

std::vector<Option> load_rows() {
    return grouped(
        "Yarn and hair",
        {
            {"--yarn-radius", "R", "(from the file, or half the distance of neighbouring yarns)",
             positive(), "scene units", "Radius of the yarn or hair."},
            {"--repeat", "NX,NY", "1,1", numbers(2, 2, 1, 10000), "tiles",
             "Number of repetitions of a periodic .pyp pattern."},
        });
}

std::vector<Option> model_rows() {
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

job::GeometryOptions geometry_options_from(const Arguments& arguments) {
    job::GeometryOptions options;
    options.yarn = arguments.find_text("yarn");
    options.yarn_radius = arguments.find_number("yarn-radius");
    const std::vector<double> repeat = arguments.numbers("repeat");
    options.repeat_x = static_cast<std::int32_t>(repeat[0]);
    options.repeat_y = static_cast<std::int32_t>(repeat[1]);
    options.fibers = arguments.find_integer("fibers");
    options.fiber_radius = arguments.find_number("fiber-radius");
    options.height_map = arguments.find_text("height-map");
    options.height_scale = arguments.find_number("height-scale");
    options.height_offset = arguments.find_number("height-offset");
    return options;
}

} // namespace heddle::cli
