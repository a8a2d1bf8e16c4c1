#include <heddle/stage/load_lights.h>

#include <heddle/base/error.h>
#include <heddle/geom/color.h>
#include <heddle/io/exr/exr.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/image/image.h>

#include <cmath>
#include <numbers>

namespace heddle {
namespace {

std::shared_ptr<EnvironmentMap> read_map(const std::string& path) {
    auto map = std::make_shared<EnvironmentMap>();
    if (suffix_of(path) == ".exr") {
        const FloatImage image = read_exr_rgb(path);
        map->width = image.width;
        map->height = image.height;
        for (std::size_t i = 0; i + 2 < image.values.size(); i += 3) {
            map->radiance.push_back({image.values[i], image.values[i + 1], image.values[i + 2]});
        }
    } else {
        const Texture image = read_image(path);
        map->width = image.width;
        map->height = image.height;
        const auto channels = static_cast<std::size_t>(image.channels);
        const std::size_t color = channels < 3 ? 0 : 1; // grey repeats its one
        for (std::size_t i = 0; i < image.texels.size(); i += channels) {
            map->radiance.push_back({linear_from_srgb_byte<float>(image.texels[i]),
                                     linear_from_srgb_byte<float>(image.texels[i + color]),
                                     linear_from_srgb_byte<float>(image.texels[i + 2 * color])});
        }
    }
    if (map->width != 2 * map->height) {
        throw Error(ErrorCode::BadFile,
                    str("is ", map->width, " x ", map->height,
                        " pixels; an environment is twice as wide as high"),
                    "give a latitude-longitude picture", {.path = path});
    }
    for (const Vec3f& c : map->radiance) {
        const bool usable =
            c.x >= 0.0f && c.y >= 0.0f && c.z >= 0.0f && std::isfinite(c.x + c.y + c.z);
        if (usable) continue;
        throw Error(ErrorCode::BadFile, "has a texel that is negative or not finite",
                    "clean it up first", {.path = path});
    }
    return map;
}

Light from_scene(const SceneLight& from, Vec3d up) {
    Light out;
    out.color = from.color;
    switch (from.kind) {
    case SceneLight::Kind::Constant: out.kind = LightKind::Constant; break;
    case SceneLight::Kind::Directional:
        out.kind = LightKind::Directional;
        out.direction = to_float(normalize(from.direction));
        break;
    case SceneLight::Kind::Point:
        out.kind = LightKind::Point;
        out.position = from.position;
        break;
    case SceneLight::Kind::Area:
        out.kind = LightKind::Area;
        out.position = from.position;
        out.edge_u = from.edge_u;
        out.edge_v = from.edge_v;
        break;
    case SceneLight::Kind::Environment: {
        out.kind = LightKind::Environment;
        std::shared_ptr<EnvironmentMap> map = read_map(from.image);
        const Vec3f axis = to_float(normalize(up));
        const Vec3f p = any_perpendicular(axis);
        const Vec3f across = axis.y > 0.9f ? Vec3f{0, 0, 1} : p; // y up: the middle column is +z
        const Vec3f front = normalize(across - axis * dot(across, axis));
        const double turn = from.turn_deg * std::numbers::pi / 180.0;
        map->up = axis;
        map->front = front * static_cast<float>(std::cos(turn)) +
                     cross(axis, front) * static_cast<float>(std::sin(turn));
        out.map = std::move(map);
        break;
    }
    }
    return out;
}

} // namespace

std::vector<Light> load_lights(const Scene& scene, Vec3d up) {
    std::vector<Light> out;
    for (const SceneLight& light : scene.lights) out.push_back(from_scene(light, up));
    if (!out.empty()) return out;
    Light sky;
    sky.color = {0.35f, 0.4f, 0.5f};
    Light sun;
    sun.kind = LightKind::Directional;
    sun.color = {4.0f, 3.8f, 3.4f};
    sun.direction = normalize(Vec3f{-0.7f, -1.0f, -0.5f});
    return {sky, sun};
}

} // namespace heddle
