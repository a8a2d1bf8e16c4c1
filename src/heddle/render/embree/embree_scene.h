#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/affine.h>
#include <heddle/geom/geometry.h>
#include <heddle/render/surface_scene.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace heddle {

/// Geometry that is traced directly, with one or more instances.
struct TracedObject {
    std::shared_ptr<const Geometry> geometry;
    std::vector<Affine> instances;        ///< object to world, at least one, none singular
    std::vector<std::uint32_t> materials; ///< per material of the geometry: index among the scene's
};

/// How explicit geometry is built.
struct EmbreeOptions {
    std::uint64_t seed = 0; ///< gives the same fibers as VoxelizeOptions::seed
    /// Largest distance, in fiber radii, of nine tenths of a traced fiber's length from the fiber
    /// of the yarn model. It sets the number of cubics per span of a yarn; fewer if memory is
    /// short.
    float tolerance = 0.03f;
    std::int64_t memory_bytes = std::int64_t{12} << 30; ///< limit for the scene
};

/// Builds the traced reference: round curves and triangles in Embree. Yarns are expanded to the
/// same fibers as by the voxelizer with the same seed, including flyaway hairs and loops.
///
/// A hit's scatterer:
/// - triangles: `axis` is the shading normal on the ray's side, `tangent` the direction of
///   anisotropy. Maps are read bilinearly at their finest level. Alpha cuts holes; blended alpha
///   is compared with a hash of the hit, so that a ray always has the same result.
/// - curves of LobeFiber and Hair: `axis` is the fiber's tangent, `tangent` the geometric normal.
/// - curves of LambertFiber, the model of a round Lambertian fiber: the traced fiber is itself
///   round, so the scatterer is a diffuse Surface, `axis` the normal, `tangent` the fiber's.
/// - microflakes on explicit geometry, and fiber models on triangles: a diffuse Surface too.
///
/// TracedHit::offset is a few rounding errors of the position. Curves are hit from outside only: a
/// ray that starts inside a fiber leaves it without a hit. Transmitted rays start at -offset along
/// `normal`, reflected rays at +offset.
///
/// Cubic curves have open ends, linear curves round ends. Radii are interpolated with the curve's
/// basis. Colours of points multiply the albedo, constant per span as in the voxelizer.
///
/// @param objects    may be empty, and so may their geometry
/// @param materials  of the scene
/// @param progress   is told about the progress and can cancel the build
/// @throws Error  InvalidArgument: an index out of range, a singular or infinite instance, an
///                object without instances; Unsupported: a material that displaces by a height map;
///                OutOfMemory: more than options.memory_bytes; Cancelled
[[nodiscard]] std::unique_ptr<SurfaceScene>
build_embree_scene(std::span<const TracedObject> objects,
                   std::vector<ScatterMaterial> materials,
                   Progress& progress,
                   const EmbreeOptions& options = {});

} // namespace heddle
