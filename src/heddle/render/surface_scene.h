#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/bounds.h>
#include <heddle/render/volume/ray.h>
#include <heddle/scatter/scatterer.h>

#include <cstdint>

namespace heddle {

/// Where a ray meets explicit geometry.
struct TracedHit {
    float t = 0.0f;           ///< scene units
    Scatterer scatterer;      ///< with maps looked up; `axis` on the ray's side for surfaces
    Vec3f normal;             ///< geometric, unit, on the ray's side
    float offset = 0.0f;      ///< a new ray starts so far along +-normal to leave what it stands on
    std::uint32_t object = 0; ///< number of the instance
    std::uint32_t material = 0; ///< of the scene's list of scatter materials
};

/// Explicit geometry, instanced: the traced reference, and meshes among volumes. Never changes: any
/// number of threads.
class SurfaceScene {
public:
    virtual ~SurfaceScene() = default;
    /// The nearest hit before ray.t_max; false where there is none.
    [[nodiscard]] virtual bool intersect(const Ray& ray, TracedHit& hit) const = 0;
    /// True where anything is met before ray.t_max.
    [[nodiscard]] virtual bool occluded(const Ray& ray) const = 0;
    /// Of all instances, in the world.
    [[nodiscard]] virtual Bounds bounds() const = 0;
    [[nodiscard]] virtual std::int64_t byte_count() const = 0;
};

} // namespace heddle
