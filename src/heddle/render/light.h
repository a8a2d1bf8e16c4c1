#pragma once

#include <heddle/base/vec.h>
#include <heddle/render/volume/ray.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace heddle {

/// A latitude-longitude image of distant light. Row 0 is straight up.
struct EnvironmentMap {
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::vector<Vec3f> radiance; ///< width x height
    Vec3f up{0, 1, 0};           ///< unit
    Vec3f front{0, 0, 1};        ///< unit, perpendicular to `up`: the middle column
};

/// The kinds of lights.
enum class LightKind : std::uint8_t { Constant, Environment, Directional, Point, Area };

/// A light in world space.
struct Light {
    LightKind kind = LightKind::Constant;
    Vec3f color{1, 1, 1};      ///< radiance, irradiance (directional) or intensity (point)
    Vec3f direction{0, 0, -1}; ///< directional: direction in which light travels, unit
    Vec3d position{};          ///< point; area: a corner
    Vec3d edge_u{1, 0, 0};     ///< area: emits on the side of cross(edge_u, edge_v)
    Vec3d edge_v{0, 1, 0};
    std::shared_ptr<const EnvironmentMap> map; ///< environment; multiplied by `color`
};

/// Light that arrives at a point if nothing occludes it.
struct LightSample {
    Vec3f direction;  ///< unit, from the point to the light
    Vec3f radiance;   ///< divided by the density of the sample; zero: no light
    float pdf = 0.0f; ///< per steradian; 0: a point or directional light
    float distance = 0.0f;
};

/// Light that a ray hits.
struct LightHit {
    Vec3f radiance{};
    float pdf = 0.0f; ///< density with which `sample` draws this direction
    float t = 0.0f;   ///< scene units; infinity: the background
};

/// All lights of a scene. Immutable, so any number of threads may use it.
class LightSet {
public:
    /// @param scene_radius  of a ball about all objects, to compare distant lights with others
    LightSet(std::vector<Light> lights, double scene_radius);

    /// Draws a light, and a direction to it.
    /// @param u  three numbers in [0, 1)
    [[nodiscard]] LightSample sample(Vec3d from, Vec3f u) const;
    /// Finds the nearest area light before ray.t_max.
    [[nodiscard]] bool intersect(const Ray& ray, LightHit& hit) const;
    /// Returns the distant light along a ray that hits nothing.
    [[nodiscard]] LightHit background(Vec3f direction) const;
    [[nodiscard]] bool empty() const { return lights_.empty(); }

private:
    struct MapTable {
        std::vector<float> rows;    ///< running sum of the rows' probabilities: height + 1
        std::vector<float> columns; ///< running sum within each row: width + 1
    };
    [[nodiscard]] float map_pdf(std::size_t light, Vec3f direction) const;
    [[nodiscard]] static Vec3f map_radiance(const Light& light, Vec3f direction);
    [[nodiscard]] Vec3f sample_map(std::size_t light, float u, float v) const;
    /// Combines all distant lights for a direction that one of them drew (multiple importance
    /// sampling).
    [[nodiscard]] LightSample sample_of_background(Vec3f direction) const;

    std::vector<Light> lights_;
    std::vector<float> share_;     ///< probability of each light
    std::vector<MapTable> tables_; ///< per light; empty unless it is an environment
};

} // namespace heddle
