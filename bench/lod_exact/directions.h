#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/voxel/voxel_level.h>

#include <cstdint>
#include <functional>
#include <span>

namespace heddle::bench {

/// What lobes are compared with directions of: the two are never mixed.
enum class Kind : std::uint8_t {
    Main,   ///< tangents of fibers, or normals of surfaces
    Tangent ///< tangents of anisotropic surfaces, weighted by strength
};

/// A direction of the geometry, the voxel of level 0 in which it is, and its directed area.
struct Directed {
    Vec3i voxel;
    Vec3f d;            ///< unit
    float weight = 0.0; ///< scene units^2
    Kind kind = Kind::Main;
};

/// Takes some millions of directions at a time, always in the same order.
using TakeDirections = std::function<void(std::span<const Directed>)>;

/// Walks every fiber of every curve and yarn in steps of at most 1/8 subvoxel. Up to 8 steps in one
/// voxel make one direction, of weight length x diameter.
///
/// Positions come from the yarns' definition, in double precision: of the voxelizer only the cubics,
/// the frames at their ends and the places of fibers in a ply are used, neither chords nor lanes.
/// @param geometry  without flyaways
void walk_fibers(const Geometry& geometry,
                 const Lattice& lattice,
                 std::uint64_t seed,
                 const TakeDirections& take);

/// Lays points on every triangle, one per (spacing x smallest subvoxel edge)^2, all of a triangle
/// weighing the same. Normals, tangents and alpha are those of the voxelizer's sampler at the point,
/// read at a footprint of that size.
/// @param geometry  without displaced surfaces
void walk_triangles(const Geometry& geometry,
                    const Lattice& lattice,
                    double spacing,
                    const TakeDirections& take);

} // namespace heddle::bench
