#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/bounds.h>
#include <heddle/render/volume/ray.h>
#include <heddle/scatter/scatterer.h>

#include <cstdint>

namespace heddle {

/// The hit of a ray on explicit geometry.
struct TracedHit {
    float t = 0.0f;             ///< scene units
    Scatterer scatterer;        ///< maps are applied; for surfaces, `axis` is on the ray's side
    Vec3f normal;               ///< geometric, unit, on the ray's side
    float offset = 0.0f;        ///< new rays start at this distance along +-normal, scene units
    std::uint32_t object = 0;   ///< number of the instance
    std::uint32_t material = 0; ///< index among the scene's scatter materials
};

/// Instances of explicit geometry: the traced reference, and meshes among volumes. Immutable, so
/// any number of threads may use it.
class SurfaceScene {
public:
    virtual ~SurfaceScene() = default;
    /// Finds the nearest hit before ray.t_max; returns false if there is none.
    [[nodiscard]] virtual bool intersect(const Ray& ray, TracedHit& hit) const = 0;
    /// Returns true if anything is hit before ray.t_max.
    [[nodiscard]] virtual bool occluded(const Ray& ray) const = 0;
    /// Bounds of all instances, in world space.
    [[nodiscard]] virtual Bounds bounds() const = 0;
    [[nodiscard]] virtual std::int64_t byte_count() const = 0;
};

} // namespace heddle
