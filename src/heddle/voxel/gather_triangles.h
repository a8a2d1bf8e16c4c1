#pragma once

#include <heddle/base/progress.h>
#include <heddle/voxel/accumulator.h>
#include <heddle/voxel/bin.h>
#include <heddle/voxel/displace.h>
#include <heddle/voxel/surface_hits.h>
#include <heddle/voxel/surface_sample.h>
#include <heddle/voxel/voxelize.h>

#include <cstdint>
#include <span>
#include <vector>

namespace heddle {

/// What all threads read of a geometry's surfaces: its maps, and the normals that height maps move
/// points along. Made once for a voxel size.
class SurfaceSource {
public:
    /// @param geometry  must outlive it, unchanged
    /// @throws Error    as SurfaceSampler
    SurfaceSource(const Geometry& geometry, const LatticeUnits& units, std::uint64_t seed);

    [[nodiscard]] const SurfaceSampler& sampler() const { return sampler_; }
    /// Scene units.
    [[nodiscard]] Vec3d subvoxel_size() const { return subvoxel_size_; }
    /// A displaced triangle's corners, normals and uv.
    [[nodiscard]] DisplaceTriangle displaced(std::uint32_t mesh, std::size_t triangle) const;

    /// Upper bound of the bytes that it takes, before anything is built.
    [[nodiscard]] static std::int64_t predict_bytes(const Geometry& geometry);

private:
    const Geometry& geometry_;
    Vec3d subvoxel_size_;
    SurfaceSampler sampler_;
    std::vector<std::vector<Vec3f>> normals_; ///< per mesh; empty unless displaced without its own
};

/// Adds triangles to blocks. One per thread.
///
/// Every centre line of a column that a triangle meets in a subvoxel of the block sets the column's
/// bit and the subvoxel's, and pools the normal, weighted by the area that the hit stands for
/// (`hit_weight`). Maps' values and anisotropic tangents go to the map sums where the block has some.
/// A hit that alpha cuts away leaves nothing.
class TriangleGatherer {
public:
    TriangleGatherer(const TriangleSource& triangles,
                     const SurfaceSource& surfaces,
                     const LatticeUnits& units,
                     FitMode fit);

    /// Adds what lies in the block of all the triangles.
    /// @param triangles  with kTriangleBit set, ascending
    /// @throws Error     Cancelled
    TriangleWork
    gather(std::span<const Primitive> triangles, BlockSums& block, const Progress& progress);

private:
    TriangleWork gather_displaced(TriangleSource::Place at, BlockSums& block);

    const TriangleSource& triangles_;
    const SurfaceSource& surfaces_;
    LatticeUnits units_;
    bool last_;
    DisplaceScratch scratch_;
};

} // namespace heddle
