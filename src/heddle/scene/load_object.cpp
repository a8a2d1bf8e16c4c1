#include <heddle/scene/load_object.h>

#include <heddle/base/error.h>
#include <heddle/io/geometry/apply_yarn.h>
#include <heddle/io/geometry/read_geometry.h>

namespace heddle {

Geometry load_object_geometry(const SceneObject& object) {
    const auto refuse = [&](const std::string& what, const std::string& fix) {
        throw Error(ErrorCode::InvalidArgument, str("object '", object.name, "' ", what), fix);
    };
    YarnOptions options;
    if (!object.yarn.empty()) options.yarn = object.yarn;
    options.yarn_radius = static_cast<float>(object.yarn_radius);
    options.fibers = object.fibers;
    options.fiber_radius = static_cast<float>(object.fiber_radius);
    if (!object.generate && object.geometry.empty()) {
        refuse("has no geometry", "give it 'geometry' or 'generate'");
    }
    Geometry geometry = object.generate
                            ? generate(*object.generate)
                            : read_geometry(object.geometry, {.radius = options.yarn_radius});
    const bool asked = options.yarn || options.yarn_radius > 0.0f || options.fiber_radius > 0.0f;
    if (asked && geometry.curves.empty()) {
        refuse("has a yarn or a radius, but its geometry has no curves",
               "drop 'yarn', 'yarn_radius' and 'fiber_radius'");
    }
    apply_yarn(geometry, options);
    return geometry;
}

} // namespace heddle
