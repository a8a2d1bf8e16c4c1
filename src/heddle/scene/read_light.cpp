#include <heddle/scene/scene_parts.h>

#include <heddle/base/error.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace heddle::scene_form {
namespace {

using Kind = SceneLight::Kind;

/// In the order of SceneLight::Kind.
const std::vector<std::string_view> kKinds{"constant", "environment", "directional", "point",
                                           "area"};

/// The vector, scaled to length 1; a problem if it has no direction.
Vec3d read_direction(TableReader& reader, std::string_view key) {
    Vec3d v{0, 0, -1};
    reader.require(key, "write 'direction = [x, y, z]', the way light travels");
    reader.vector(key, v);
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0.0)) {
        reader.problem(key, str("'", key, "' has no length"), "write where light travels to");
        return v;
    }
    return normalize(v * (1.0 / largest)); // so squares neither overflow nor underflow
}

void read_area(TableReader& reader, SceneLight& light) {
    for (const char* key : {"position", "edge_u", "edge_v"}) {
        reader.require(key, "an area light is a corner and two edges");
    }
    reader.vector("position", light.position);
    reader.vector("edge_u", light.edge_u);
    reader.vector("edge_v", light.edge_v);
    const double area = length(cross(light.edge_u, light.edge_v));
    if (!(area > 1e-9 * length(light.edge_u) * length(light.edge_v))) {
        reader.problem("edge_v", "'edge_u' and 'edge_v' are parallel or have no length",
                       "make them span a parallelogram");
    }
}

void read_color(TableReader& reader, SceneLight& light) {
    double strength = 1.0;
    reader.color("color", light.color);
    reader.number("strength", strength, kNotNegative);
    // in double: the product of two floats may overflow a float
    const Vec3d color = to_double(light.color) * strength;
    const double largest = std::max({color.x, color.y, color.z});
    if (!(largest > 0.0)) {
        reader.problem(reader.has("strength") ? "strength" : "color", "the light has no energy",
                       "give 'color' and 'strength' above 0, or drop the light");
    } else if (!kAnyNumber.holds(largest)) {
        reader.problem("strength", str("'color' times 'strength' is ", largest),
                       str("keep it below ", kAnyNumber.most));
    } else {
        light.color = to_float(color);
    }
}

} // namespace

SceneLight read_light(TableReader& reader) {
    SceneLight light;
    reader.require("kind", "write 'kind = \"constant\"', or environment, directional, point, area");
    const std::optional<std::size_t> kind = reader.choose("kind", kKinds);
    if (!kind) return light; // the allowed keys depend on it
    light.kind = static_cast<Kind>(*kind);
    reader.set_what(str("a light of kind '", kKinds[*kind], "'"));
    read_color(reader, light);
    switch (light.kind) {
    case Kind::Constant: break;
    case Kind::Environment:
        reader.require("image", "name an .exr, .png or .jpg, width twice its height");
        reader.path("image", light.image, {".exr", ".png", ".jpg", ".jpeg"});
        reader.number("turn", light.turn_deg);
        break;
    case Kind::Directional: light.direction = read_direction(reader, "direction"); break;
    case Kind::Point:
        reader.require("position", "write 'position = [x, y, z]'");
        reader.vector("position", light.position);
        break;
    case Kind::Area: read_area(reader, light); break;
    }
    reader.finish();
    return light;
}

} // namespace heddle::scene_form
