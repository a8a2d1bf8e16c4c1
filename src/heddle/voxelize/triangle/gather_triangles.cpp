#include <heddle/voxelize/triangle/gather_triangles.h>

#include <heddle/voxelize/triangle/material_sums.h>
#include <heddle/voxelize/triangle/triangle_op.h>

namespace heddle {

TriangleGatherer::TriangleGatherer(const SurfaceSource& surfaces,
                                   const LatticeUnits& units,
                                   FitMode fit)
    : surfaces_(surfaces), units_(units), last_(fit == FitMode::Last) {}

TriangleWork TriangleGatherer::gather(std::span<const Primitive> triangles,
                                      BlockSums& block,
                                      const Progress& progress) {
    const SurfaceView& view = surfaces_.view();
    TriangleWork work;
    std::size_t done = 0;
    for (const Primitive id : triangles) {
        if (done++ % 256 == 0) progress.check();
        const TriangleId at = view.place(triangle_of(id));
        MaterialSums sums(block, view.meshes[at.mesh].material, last_);
        work = work + add_triangle(view, at, units_, block.lo(), block.hi(), sums, scratch_);
    }
    return work;
}

} // namespace heddle
