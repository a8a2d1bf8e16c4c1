#pragma once

#include <heddle/base/vec.h>
#include <heddle/render/volume/ray.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace heddle {

/// A latitude-longitude picture of light from far away: row 0 is straight up.
struct EnvironmentMap {
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::vector<Vec3f> radiance; ///< width x height
    Vec3f up{0, 1, 0};           ///< unit
    Vec3f front{0, 0, 1};        ///< unit, at right angles to `up`: the middle column
};

enum class LightKind : std::uint8_t { Constant, Environment, Directional, Point, Area };

/// A light in world space.
struct Light {
    LightKind kind = LightKind::Constant;
    Vec3f color{1, 1, 1};      ///< radiance, irradiance (directional) or intensity (point)
    Vec3f direction{0, 0, -1}; ///< directional: the way light travels, unit
    Vec3d position{};          ///< point; area: a corner
    Vec3d edge_u{1, 0, 0};     ///< area: lit on the side of cross(edge_u, edge_v)
    Vec3d edge_v{0, 1, 0};
    std::shared_ptr<const EnvironmentMap> map; ///< environment; color multiplies it
};

/// Light that may arrive at a place, before anything stands in between.
struct LightSample {
    Vec3f direction;  ///< unit, from the place to the light
    Vec3f radiance;   ///< divided by the density that it was drawn with; zero: none
    float pdf = 0.0f; ///< per steradian; 0: from one direction alone, no ray meets it
    float distance = 0.0f;
};

/// Light that a ray meets.
struct LightHit {
    Vec3f radiance{};
    float pdf = 0.0f; ///< with which `sample` would have drawn the direction
    float t = 0.0f;   ///< infinity: the background
};

/// All lights of a scene. Never changes: any number of threads.
class LightSet {
public:
    /// @param scene_radius  of a ball about all objects: weighs far lights against near ones
    LightSet(std::vector<Light> lights, double scene_radius);

    /// Draws a light, and a direction to it.
    /// @param u  three numbers in [0, 1)
    [[nodiscard]] LightSample sample(Vec3d from, Vec3f u) const;
    /// The nearest area light before ray.t_max.
    [[nodiscard]] bool intersect(const Ray& ray, LightHit& hit) const;
    /// Light from infinity along a ray that meets nothing.
    [[nodiscard]] LightHit background(Vec3f direction) const;
    [[nodiscard]] bool empty() const { return lights_.empty(); }

private:
    struct MapTable {
        std::vector<float> rows;    ///< running sum of rows' shares: height + 1
        std::vector<float> columns; ///< per row: width + 1
    };
    [[nodiscard]] float map_pdf(std::size_t light, Vec3f direction) const;
    [[nodiscard]] static Vec3f map_radiance(const Light& light, Vec3f direction);
    [[nodiscard]] Vec3f sample_map(std::size_t light, float u, float v) const;
    /// All lights from infinity as one: what any of them drew is weighed by all densities.
    [[nodiscard]] LightSample sample_of_background(Vec3f direction) const;

    std::vector<Light> lights_;
    std::vector<float> share_;     ///< probability of each light
    std::vector<MapTable> tables_; ///< per light; empty unless it is an environment
};

} // namespace heddle
