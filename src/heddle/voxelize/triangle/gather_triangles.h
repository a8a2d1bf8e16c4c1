#pragma once

#include <heddle/base/progress.h>
#include <heddle/surface/surface_source.h>
#include <heddle/voxelize/block/accumulator.h>
#include <heddle/voxelize/block/gather_options.h>
#include <heddle/voxelize/block/primitive.h>
#include <heddle/voxelize/triangle/displace.h>
#include <heddle/voxelize/triangle/surface_hits.h>

#include <span>

namespace heddle {

/// Adds triangles to blocks by add_triangle() (triangle_op.h). Each thread needs its own.
class TriangleGatherer {
public:
    TriangleGatherer(const SurfaceSource& surfaces, const LatticeUnits& units, FitMode fit);

    /// Adds the parts of the triangles inside the block to its sums.
    /// @param triangles  with kTriangleBit set, ascending
    /// @throws Error     Cancelled
    TriangleWork
    gather(std::span<const Primitive> triangles, BlockSums& block, const Progress& progress);

private:
    const SurfaceSource& surfaces_;
    LatticeUnits units_;
    bool last_;
    DisplaceScratch scratch_;
};

} // namespace heddle
