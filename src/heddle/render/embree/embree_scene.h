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

/// Geometry to be traced as it is, at one or more places.
struct TracedObject {
    std::shared_ptr<const Geometry> geometry;
    std::vector<Affine> instances;        ///< object to world, at least one, none singular
    std::vector<std::uint32_t> materials; ///< of each of the geometry's: index among the scene's
};

/// How explicit geometry is laid out.
struct EmbreeOptions {
    std::uint64_t seed = 0; ///< of yarns' fibers: as VoxelizeOptions::seed, for the same fibers
    /// Largest distance of a traced fiber from the yarn model's, in fiber radii, over nine tenths
    /// of its length. Cubics per span of the yarn follow from it, and fewer where memory is short.
    float tolerance = 0.03f;
    std::int64_t memory_bytes = std::int64_t{12} << 30; ///< most that the scene may take
};

/// Builds the traced reference: round curves and triangles in Embree, yarns expanded to the fibers
/// that the voxelizer has under the same seed (flyaway hairs and loops included).
///
/// A hit's scatterer:
/// - triangles: `axis` is the shading normal on the ray's side, `tangent` the direction of
///   anisotropy. Maps are read bilinearly at their finest level. Alpha cuts holes; blended alpha by
///   a hash of the hit, so that one ray sees the same each time.
/// - curves of LobeFiber and Hair: `axis` is the fiber's tangent, `tangent` the geometric normal.
/// - curves of LambertFiber, which stands for a round Lambertian fiber: here the fiber is round, so
///   the scatterer is a Surface without specular, `axis` the normal, `tangent` the fiber's.
/// - microflakes of explicit geometry, and fiber models on triangles: Surface without specular too.
///
/// TracedHit::offset is a few roundings of the position. Curves are met from outside only: a ray
/// that starts on the far side of `normal`, inside the fiber, leaves it without a hit; what passes
/// through a fiber starts at -offset, what is reflected at +offset.
///
/// Ends of cubic curves are open, those of linear ones round. Radii are interpolated with the
/// curve's own basis. Colours of points multiply the albedo, span by span as in the voxelizer.
///
/// @param objects    may be empty, as their geometry may
/// @param materials  of the scene
/// @param progress   reported to and asked while the scene is built
/// @throws Error  InvalidArgument: an index out of range, a singular or infinite instance, an
///                object without instances; Unsupported: a material that displaces by a height map;
///                OutOfMemory: more than options.memory_bytes; Cancelled
[[nodiscard]] std::unique_ptr<SurfaceScene>
build_embree_scene(std::span<const TracedObject> objects,
                   std::vector<ScatterMaterial> materials,
                   Progress& progress,
                   const EmbreeOptions& options = {});

} // namespace heddle
