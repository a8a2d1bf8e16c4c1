#pragma once

#include <heddle/render/volume/test_volume.h>
#include <heddle/sggx/moments.h>
#include <heddle/voxel/plane_slab.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

// Levels of opaque surfaces with slabs, voxelized without the voxelizer: voxels of edge 1.

namespace heddle::testing {

struct SurfacePoint {
    Vec3d at, normal;
};

/// Returns the points of a surface on a line along an axis.
using CrossSurface = std::function<std::vector<SurfacePoint>(int axis, Vec3d line)>;

/// A plane through `at`, where `has` says so.
inline CrossSurface plane_at(
    Vec3d at, Vec3d normal, const std::function<bool(Vec3d)>& has = [](Vec3d) { return true; }) {
    const Vec3d n = normalize(normal);
    return [=](int axis, Vec3d line) -> std::vector<SurfacePoint> {
        if (std::fabs(n[axis]) < 1e-9) return {};
        line[axis] = 0.0;
        line[axis] = dot(n, at - line) / n[axis];
        if (!has(line)) return {};
        return {{line, n}};
    };
}

inline CrossSurface sphere_at(Vec3d center, double radius) {
    return [=](int axis, Vec3d line) -> std::vector<SurfacePoint> {
        Vec3d from = line - center;
        from[axis] = 0.0;
        const double rest = radius * radius - dot(from, from);
        if (rest <= 0.0) return {};
        std::vector<SurfacePoint> out;
        for (const double sign : {-1.0, 1.0}) {
            from[axis] = sign * std::sqrt(rest);
            out.push_back({center + from, normalize(from)});
        }
        return out;
    };
}

/// Returns a level whose voxels in [-extent, extent)^3 hold the surface, with one lobe each and
/// 8 x 2^level columns per axis. All lengths are in voxels.
inline std::shared_ptr<const TraversalLevel>
sheet_level(const CrossSurface& surface, int extent, int level = 0, bool slabs = true) {
    struct Sums {
        std::array<std::set<std::pair<int, int>>, 3> columns;
        SymmetricMatrix moment{};
        double weight = 0.0;
        std::vector<Vec3d> points;
    };
    std::map<std::tuple<int, int, int>, Sums> sums;
    const int n = 8 << level;
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < 2 * extent * n; ++i) {
            for (int j = 0; j < 2 * extent * n; ++j) {
                Vec3d line{};
                line[(axis + 1) % 3] = (i + 0.5) / n - extent;
                line[(axis + 2) % 3] = (j + 0.5) / n - extent;
                for (const auto& [at, normal] : surface(axis, line)) {
                    if (!(std::fabs(at[axis]) < extent)) continue;
                    const auto cell = [](double x) { return static_cast<int>(std::floor(x)); };
                    Sums& s = sums[{cell(at.x), cell(at.y), cell(at.z)}];
                    s.columns[static_cast<std::size_t>(axis)].insert({i, j});
                    const double w = std::fabs(normal[axis]);
                    const auto add = [&](float& m, double x) { m += static_cast<float>(w * x); };
                    add(s.moment.xx, normal.x * normal.x), add(s.moment.yy, normal.y * normal.y);
                    add(s.moment.zz, normal.z * normal.z), add(s.moment.xy, normal.x * normal.y);
                    add(s.moment.xz, normal.x * normal.z), add(s.moment.yz, normal.y * normal.z);
                    s.weight += w;
                    s.points.push_back(at);
                }
            }
        }
    }
    VoxelMap voxels;
    std::map<std::tuple<int, int, int>, PlaneSlab> slab_of;
    for (auto& [at, s] : sums) {
        const auto k = static_cast<float>(1.0 / s.weight);
        for (float* m :
             {&s.moment.xx, &s.moment.yy, &s.moment.zz, &s.moment.xy, &s.moment.xz, &s.moment.yz}) {
            *m *= k;
        }
        const PackedSggx lobe = pack(fit_sggx(s.moment));
        const auto cover = [&](std::size_t a) {
            return share16(static_cast<double>(s.columns[a].size()) / (n * n));
        };
        voxels[at] = {{cover(0), cover(1), cover(2), cover(0)}, {{lobe, 255, 0}}};
        const PackedNormal normal = pack_normal(to_double(principal_direction(s.moment)));
        const Vec3d gradient = slab_gradient(unpack_normal(normal), {1, 1, 1});
        double lo = 1e9, hi = -1e9;
        const auto [x, y, z] = at;
        for (const Vec3d& p : s.points) {
            const double v = slab_value(gradient, p - Vec3d{x + 0.5, y + 0.5, z + 0.5});
            lo = std::min(lo, v);
            hi = std::max(hi, v);
        }
        slab_of[at] = {round_slab_value(lo), round_slab_value(hi), normal};
    }
    MemoryLevel grid;
    grid.info().lattice = {{1, 1, 1}, n};
    grid.info().level = level;
    grid.info().materials.resize(1);
    grid.info().materials[0].kind = MaterialKind::Surface;
    grid.info().fields.slabs = slabs;
    grid.blocks = make_blocks(voxels);
    for (VoxelBlock& block : grid.blocks) {
        if (!slabs) continue;
        for (const VoxelLeaf& leaf : block.leaves) {
            for (int bit = 0; bit < 512; ++bit) {
                if ((leaf.active[static_cast<std::size_t>(bit >> 6)] >> (bit & 63) & 1) == 0)
                    continue;
                block.slabs.push_back(
                    slab_of.at({leaf.origin.x + (bit >> 6), leaf.origin.y + (bit >> 3 & 7),
                                leaf.origin.z + (bit & 7)}));
            }
        }
    }
    count_voxels(grid);
    return std::make_shared<const TraversalLevel>(grid);
}

} // namespace heddle::testing
