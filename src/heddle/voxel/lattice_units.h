#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>
#include <heddle/voxel/voxel_level.h>

#include <algorithm>

namespace heddle {

/// Voxels along a block's edge. The sums of a block (at most 5 MiB; cloth fills a third) fit in a
/// core's share of the cache, and few spans cross a border and are expanded twice. 32 was the
/// fastest of 16, 32 and 64.
constexpr int kBlockVoxels = 32;

/// A lattice measured in its own unit, the smallest subvoxel edge. Lengths stay isotropic if voxels
/// are not cubes, and numbers stay small.
struct LatticeUnits {
    double unit = 1.0;         ///< scene units
    Vec3d voxel_size;          ///< scene units
    int n = 8;                 ///< subvoxels per axis
    Vec3f edge;                ///< subvoxel edges, units; the smallest is 1
    Vec3f voxel;               ///< voxel edges, units
    Vec3f inv_edge, inv_voxel; ///< reciprocals of `edge` and `voxel`

    LatticeUnits() = default;
    explicit LatticeUnits(const Lattice& lattice)
        : voxel_size(lattice.voxel_size), n(lattice.subvoxels) {
        const Vec3d& h = lattice.voxel_size;
        unit = std::min({h.x, h.y, h.z}) / n;
        for (int a = 0; a < 3; ++a) {
            edge[a] = static_cast<float>(h[a] / n / unit);
            voxel[a] = edge[a] * static_cast<float>(n);
            inv_edge[a] = 1.0f / edge[a];
            inv_voxel[a] = 1.0f / voxel[a];
        }
    }
};

} // namespace heddle
