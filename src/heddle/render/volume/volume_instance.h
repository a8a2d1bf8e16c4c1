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

/// The levels of an object, finest first; a level that a picture does not need is null.
using TraversalLevels = std::vector<std::shared_ptr<const TraversalLevel>>;

/// Where a flight ended.
struct VolumeHit {
    float t = 0.0f;
    int level = 0;
    const TraversalLeaf* leaf = nullptr;
    std::int64_t voxel = 0;
};

/// What a flight ended on.
struct VolumeScatter {
    Scatterer scatterer;
    std::uint32_t material = 0; ///< of the scene's
    bool fiber = false;         ///< a tangent was drawn; else a normal
    float radius = 0.0f;        ///< of a fiber, world units; 0 where unknown
    float edge = 0.0f;          ///< of the voxel, world units
};

/// Which level a ray walks.
struct LevelChoice {
    int forced = -1;     ///< this one everywhere; -1: by the ray's width
    float offset = 0.0f; ///< added to the level that the width asks for
    float draw = 0.5f;   ///< uniform in [0, 1): which of the two levels beside a fractional one
};

/// A levelled object placed in the world.
class VolumeInstance {
public:
    /// @param pyramid    at least one level that is not null; shared by instances
    /// @param to_world   its determinant is not 0
    /// @param materials  per material of the grid: which of the scene's
    VolumeInstance(TraversalLevels pyramid,
                   const Affine& to_world,
                   std::vector<std::uint32_t> materials);

    /// Draws where a ray that starts in the open, or on a scatterer, is stopped next.
    /// @return  false: it passes until ray.t_max
    [[nodiscard]] bool sample_flight(const Ray& ray,
                                     Transport transport,
                                     const LevelChoice& choice,
                                     StreamRandom& random,
                                     VolumeHit& hit) const;

    /// Share of the light that passes until ray.t_max: exact, or an estimate whose mean is exact
    /// where the transport has a state.
    [[nodiscard]] float transmittance(const Ray& ray,
                                      Transport transport,
                                      const LevelChoice& choice,
                                      StreamRandom& random) const;

    /// Draws what the ray hit: lobe and direction by how much of them is seen from `wi`.
    /// @param wi         unit, towards where the ray came from, world
    /// @param materials  the scene's
    [[nodiscard]] VolumeScatter scatter(const VolumeHit& hit,
                                        Vec3f wi,
                                        std::span<const ScatterMaterial> materials,
                                        StreamRandom& random) const;

    /// Of the finest level that is there, in the world.
    [[nodiscard]] Bounds bounds() const { return world_bounds_; }
    /// Longest edge of the finest voxels, scene units of the world.
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
    /// Turns what was drawn in the object's space. @param normal  the axis is one; else a tangent
    void turn_to_world(bool normal, Scatterer& out) const;

    TraversalLevels pyramid_;
    Affine to_world_, to_object_;
    bool rotated_ = false;
    float scale_ = 1.0f; ///< mean factor of lengths
    std::vector<std::uint32_t> materials_;
    std::vector<Bounds> level_bounds_; ///< of each level, in the object's space
    Bounds object_bounds_, world_bounds_;
    double voxel_size_ = 0.0;
};

} // namespace heddle
