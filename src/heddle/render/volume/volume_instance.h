#pragma once

#include <heddle/base/random.h>
#include <heddle/geom/affine.h>
#include <heddle/geom/bounds.h>
#include <heddle/render/volume/ray.h>
#include <heddle/render/volume/transport.h>
#include <heddle/render/volume/traversal_level.h>
#include <heddle/scatter/scatterer.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace heddle {

class RayPassage;
struct LastSheet;

/// The levels of an object, finest first; a level that a picture does not need is null.
using TraversalLevels = std::vector<std::shared_ptr<const TraversalLevel>>;

/// Where a free flight ended.
struct VolumeHit {
    float t = 0.0f;
    int level = 0;
    const TraversalLeaf* leaf = nullptr;
    std::int64_t voxel = 0;
    int side = 0; ///< of the voxel's sheet from which the ray came: 1, -1; 0: met no sheet
};

/// The scatterer at which a free flight ended.
struct VolumeScatter {
    Scatterer scatterer;
    std::uint32_t material = 0; ///< index among the scene's materials
    bool fiber = false;         ///< `scatterer.axis` is a tangent; else a normal
    float radius = 0.0f;        ///< of the fiber, scene units; 0 if unknown
    float edge = 0.0f;          ///< longest edge of the voxel, scene units
};

/// Which level a ray traverses.
struct LevelChoice {
    int forced = -1;     ///< level for all rays; -1: by the ray's width
    float offset = 0.0f; ///< added to the level that the width gives
    float draw = 0.5f;   ///< uniform in [0, 1): chooses between the two nearest levels
};

/// The levels of an object, placed in the world.
class VolumeInstance {
public:
    /// @param pyramid    at least one level that is not null; shared by instances
    /// @param to_world   its determinant is not 0
    /// @param materials  per material of the object: index among the scene's
    VolumeInstance(TraversalLevels pyramid,
                   const Affine& to_world,
                   std::vector<std::uint32_t> materials);

    /// Draws a free flight: the next point where the ray is stopped.
    /// @return  false: the ray passes until ray.t_max
    [[nodiscard]] bool sample_flight(const Ray& ray,
                                     Transport transport,
                                     const LevelChoice& choice,
                                     StreamRandom& random,
                                     VolumeHit& hit) const;

    /// Returns the transmittance until ray.t_max: exact for Transport::Product, else an unbiased
    /// estimate.
    [[nodiscard]] float transmittance(const Ray& ray,
                                      Transport transport,
                                      const LevelChoice& choice,
                                      StreamRandom& random) const;

    /// Draws the scatterer at a hit: a lobe and a direction, by their areas projected along `wi`.
    /// @param wi         unit, in world space, towards the origin of the ray
    /// @param materials  the scene's
    [[nodiscard]] VolumeScatter scatter(const VolumeHit& hit,
                                        Vec3f wi,
                                        std::span<const ScatterMaterial> materials,
                                        StreamRandom& random) const;

    /// Bounds of the finest level that is loaded, in world space.
    [[nodiscard]] Bounds bounds() const { return world_bounds_; }
    /// Longest edge of the finest voxels, scene units.
    [[nodiscard]] double voxel_size() const { return voxel_size_; }
    [[nodiscard]] const TraversalLevels& pyramid() const { return pyramid_; }

private:
    /// Calls note(level, step) where the ray stops.
    template <typename Note>
    void walk(const Ray& ray,
              Transport transport,
              const LevelChoice& choice,
              RayPassage& passage,
              const Note& note) const;
    [[nodiscard]] int usable_level(int level) const;
    /// Returns the sheet on which a ray starts, as the last one that it met.
    [[nodiscard]] LastSheet start_sheet(const Ray& ray, Vec3d direction) const;
    /// Transforms a scatterer from object to world space. @param normal  `out.axis` is a normal
    void turn_to_world(bool normal, Scatterer& out) const;

    TraversalLevels pyramid_;
    Affine to_world_, to_object_;
    bool rotated_ = false;
    float scale_ = 1.0f; ///< mean scale of to_world_
    std::vector<std::uint32_t> materials_;
    std::vector<Bounds> level_bounds_; ///< of each level, in the object's space
    Bounds object_bounds_, world_bounds_;
    double voxel_size_ = 0.0;
};

} // namespace heddle
