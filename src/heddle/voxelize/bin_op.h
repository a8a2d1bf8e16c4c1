#pragma once

#include <heddle/base/platform.h>
#include <heddle/voxel/block_range.h>
#include <heddle/voxelize/triangle/triangle_scan.h>
#include <heddle/yarn/fiber_view.h>

#include <algorithm>
#include <cmath>

namespace heddle {

/// Calls visit(x, y, z) with the index of each block of the range that the piece's control hull,
/// grown by its reach, touches.
template <typename Visit>
HEDDLE_HD inline void for_each_block(const FiberView& fibers,
                                     const FiberPiece& piece,
                                     const LatticeUnits& units,
                                     const BlockRange& range,
                                     const Visit& visit) {
    Bounds box = piece.cubic.hull();
    const double reach = fibers.reach(piece);
    box.lo = box.lo - Vec3d{reach, reach, reach};
    box.hi = box.hi + Vec3d{reach, reach, reach};
    const BlockBox blocks = blocks_of(box, range, units.voxel_size);
    for (int x = blocks.lo.x; x <= blocks.hi.x; ++x) {
        for (int y = blocks.lo.y; y <= blocks.hi.y; ++y) {
            for (int z = blocks.lo.z; z <= blocks.hi.z; ++z) visit(x, y, z);
        }
    }
}

/// Returns true if the plane of the triangle, thickened by `margin`, intersects the block's box.
[[nodiscard]] HEDDLE_HD inline bool
plane_meets(const Vec3d (&p)[3], Vec3d normal, double margin, Vec3d center, Vec3d half) {
    const double distance = dot(normal, center - p[0]);
    const double reach = std::abs(normal.x) * half.x + std::abs(normal.y) * half.y +
                         std::abs(normal.z) * half.z + margin * length(normal);
    return std::abs(distance) <= reach * (1.0 + 1e-9);
}

/// Returns how far a hit may lie outside its triangle, in scene units. The scan snaps vertices to a
/// lattice of half this pitch.
[[nodiscard]] HEDDLE_HD inline double snap_margin(const LatticeUnits& units) {
    const Vec3d voxel = units.voxel_size;
    return 2.0 * (std::max(std::max(voxel.x, voxel.y), voxel.z) /
                  (units.n * static_cast<double>(kScanOne)));
}

/// Calls visit(x, y, z) with the index of each block of the range that both the triangle's box and
/// its plane intersect.
/// @param corners  scene units
/// @param move     largest distance that height maps move its points, scene units
template <typename Visit>
HEDDLE_HD inline void for_each_block(const Vec3f (&corners)[3],
                                     double move,
                                     const LatticeUnits& units,
                                     const BlockRange& range,
                                     const Visit& visit) {
    const double margin = move + snap_margin(units);
    Vec3d p[3];
    Bounds box;
    for (int i = 0; i < 3; ++i) {
        p[i] = to_double(corners[i]);
        box.grow(p[i], margin);
    }
    const BlockBox blocks = blocks_of(box, range, units.voxel_size);
    const Vec3d normal = cross(p[1] - p[0], p[2] - p[0]);
    const Vec3d half = 0.5 * kBlockVoxels * units.voxel_size;
    for (int x = blocks.lo.x; x <= blocks.hi.x; ++x) {
        for (int y = blocks.lo.y; y <= blocks.hi.y; ++y) {
            for (int z = blocks.lo.z; z <= blocks.hi.z; ++z) {
                const Vec3d center = half + Vec3d{2.0 * x, 2.0 * y, 2.0 * z} * half;
                if (plane_meets(p, normal, margin, center, half)) visit(x, y, z);
            }
        }
    }
}

} // namespace heddle
