#pragma once

#include <heddle/device/block_pairs_op.h>
#include <heddle/device/level/dense_sums.h>
#include <heddle/voxelize/triangle/triangle_op.h>

#include <cstddef>

namespace heddle {

/// Gathers one triangle in one block. There is an op for each kind, which saves registers.
template <SurfaceKind Kind>
struct GatherTriangleOp {
    SurfaceView surfaces;
    LatticeUnits units;
    DenseSums sums;
    const BlockPair* pairs;

    HEDDLE_HD void operator()(std::size_t i) const {
        const BatchBlock& block = sums.blocks[pairs[i].slot];
        const TriangleId at = surfaces.place(triangle_of(pairs[i].primitive));
        const DenseLobe to = sums.lobe(pairs[i].slot, surfaces.meshes[at.mesh].material);
        add_triangle<Kind>(surfaces, at, units, block.lo, block.lo + block.size, to, NoScratch{});
    }
};

} // namespace heddle
