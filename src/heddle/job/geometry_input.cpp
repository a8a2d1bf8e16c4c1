#include <heddle/job/geometry_input.h>

#include <heddle/io/geometry/apply_yarn.h>
#include <heddle/io/geometry/read_geometry.h>
#include <heddle/io/image/image.h>
#include <heddle/io/mesh/read_mesh.h>
#include <heddle/io/yarn/yarn_file.h>
#include <heddle/job/option_error.h>

#include <utility>

namespace heddle::job {
namespace {

void refuse(bool useless, const char* option, const char* need) {
    if (useless) throw OptionError(str("`", option, "` needs ", need));
}

void check_positive(const std::optional<double>& value, const char* option) {
    if (value && !(*value > 0.0)) {
        throw OptionError(str("`", option, "` is ", *value, "; it must be > 0"));
    }
}

Geometry read_asked(GeometryInput& input) {
    const GeometryOptions& options = input.options;
    if (input.geometry) {
        refuse(options.repeat_x != 1 || options.repeat_y != 1, "repeat", "a file");
        return std::move(*input.geometry);
    }
    return read_geometry(input.path,
                         {.radius = static_cast<float>(options.yarn_radius.value_or(0.0)),
                          .repeat_x = options.repeat_x,
                          .repeat_y = options.repeat_y});
}

} // namespace

std::vector<std::string> yarn_preset_names() {
    return list_presets();
}

void check_geometry_options(const GeometryOptions& options) {
    check_positive(options.yarn_radius, "yarn_radius");
    check_positive(options.fiber_radius, "fiber_radius");
    refuse(options.fibers && !options.yarn, "fibers", "`yarn`");
    refuse(options.height_scale && !options.height_map, "height_scale", "`height_map`");
    refuse(options.height_offset && !options.height_map, "height_offset", "`height_map`");
}

Geometry load_geometry(GeometryInput input) {
    const GeometryOptions& options = input.options;
    check_geometry_options(options);
    Geometry geometry = read_asked(input);
    const bool curves = !geometry.curves.empty();
    refuse(options.yarn && !curves, "yarn", "curves, but the file holds none");
    refuse(options.fiber_radius && !curves, "fiber_radius", "curves, but the file holds none");
    refuse(options.yarn_radius && !curves, "yarn_radius", "curves, but the file holds none");
    apply_yarn(geometry, {.yarn = options.yarn,
                          .yarn_radius = static_cast<float>(options.yarn_radius.value_or(0.0)),
                          .fibers = options.fibers.value_or(0),
                          .fiber_radius = static_cast<float>(options.fiber_radius.value_or(0.0))});
    if (options.height_map) {
        set_height_map(geometry, read_image(*options.height_map),
                       static_cast<float>(options.height_scale.value_or(1.0)),
                       static_cast<float>(options.height_offset.value_or(0.0)));
    }
    return geometry;
}

} // namespace heddle::job
