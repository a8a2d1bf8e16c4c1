#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/voxel/voxel_level.h>

#include <cstdint>
#include <functional>
#include <span>

namespace heddle::bench {

/// The kinds of directions with which lobes are compared: the two are never mixed.
enum class Kind : std::uint8_t {
    Main,   ///< tangents of fibers, or normals of surfaces
    Tangent ///< tangents of anisotropic surfaces, weighted by strength
};

/// A direction of the geometry, the level 0 voxel that contains it, and its directed area.
struct Directed {
    Vec3i voxel;
    Vec3f d;            ///< unit
    float weight = 0.0; ///< scene units^2
    Kind kind = Kind::Main;
};

/// Receives some millions of directions at a time, always in the same order.
using TakeDirections = std::function<void(std::span<const Directed>)>;

/// Visits every fiber of every curve and yarn in steps of at most 1/8 subvoxel. Up to 8 steps in
/// one voxel make one direction, whose weight is length x diameter.
///
/// Positions come from the definition of yarns, in double precision. Of the voxelizer only the
/// cubics, the frames at their ends and the positions of fibers in a ply are used, not its chords
/// or lanes.
/// @param geometry  without flyaways
void walk_fibers(const Geometry& geometry,
                 const Lattice& lattice,
                 std::uint64_t seed,
                 const TakeDirections& take);

/// Places points on every triangle, one per (spacing x smallest subvoxel edge)^2; all points of a
/// triangle have the same weight. Normals, tangents and alpha are those of the voxelizer's sampler
/// at the point, with a footprint of this size.
/// @param geometry  without displaced surfaces
void walk_triangles(const Geometry& geometry,
                    const Lattice& lattice,
                    double spacing,
                    const TakeDirections& take);

} // namespace heddle::bench
