#pragma once

#include <heddle/voxelize/voxelize.h>

#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

// Small geometry in, voxels out: for the tests and the tables of bench/.

namespace heddle::test {

/// A geometry of these curves and one fiber material.
inline Geometry geometry_of(CurveSet set) {
    Geometry geometry;
    geometry.name = "test";
    Material fiber;
    fiber.name = "fiber";
    fiber.kind = MaterialKind::Fiber;
    geometry.materials.push_back(fiber);
    geometry.curves.push_back(std::move(set));
    return geometry;
}

/// Adds a curve through `points`, open unless `closed`.
inline void add_curve(CurveSet& set, const std::vector<Vec3f>& points, bool closed = false) {
    if (set.first.empty()) set.first.push_back(0);
    set.points.insert(set.points.end(), points.begin(), points.end());
    set.first.push_back(set.points.size());
    set.closed.push_back(closed ? 1 : 0);
}

inline std::unique_ptr<VoxelSource> voxelize_now(const Geometry& geometry,
                                                 const VoxelizeOptions& options) {
    Progress silent;
    return voxelize(geometry, options, plan_voxelize(geometry, options), silent);
}

/// One voxel of a result; the spans hold during the visit.
struct FoundVoxel {
    Vec3i at;
    Coverage coverage;
    std::span<const Lobe> lobes;
    std::span<const LobeMaps> maps; ///< as many as lobes, or empty
    std::uint32_t merge_order = 0;
    std::array<std::uint64_t, 3> footprints{};
    std::array<std::uint8_t, 3> correlation{};
    std::array<std::uint64_t, 3> columns{}; ///< with sums only, and
    std::span<const LobeMoment> moments;    ///< as many as lobes
};

/// Calls visit(FoundVoxel) for every voxel, in the source's order.
template <typename Visit>
void for_each_voxel(const VoxelSource& source, const Visit& visit) {
    VoxelBlock scratch;
    for (std::size_t b = 0; b < source.block_count(); ++b) {
        const VoxelBlock& block = source.block(b, scratch);
        for (const VoxelLeaf& leaf : block.leaves) {
            std::size_t voxel = leaf.first_voxel;
            std::size_t lobe = leaf.first_lobe;
            for (int i = 0; i < 512; ++i) {
                if ((leaf.active[static_cast<std::size_t>(i >> 6)] >> (i & 63) & 1u) == 0) continue;
                const std::size_t count = block.lobe_count[voxel];
                FoundVoxel found{.at = leaf.origin + Vec3i{i >> 6, i >> 3 & 7, i & 7},
                                 .coverage = block.coverage[voxel],
                                 .lobes = {block.lobes.data() + lobe, count},
                                 .maps = {},
                                 .moments = {}};
                if (!block.merge_order.empty()) found.merge_order = block.merge_order[voxel];
                if (!block.footprints.empty()) found.footprints = block.footprints[voxel];
                if (!block.correlation.empty()) found.correlation = block.correlation[voxel];
                if (!block.columns.empty()) {
                    found.columns = block.columns[voxel];
                    found.moments = {block.moments.data() + lobe, count};
                }
                if (!block.maps.empty()) found.maps = {block.maps.data() + lobe, count};
                visit(found);
                lobe += count;
                ++voxel;
            }
        }
    }
}

/// Coverage along an axis, in [0, 1].
inline double covered(const Coverage& coverage, int axis) {
    const std::uint16_t c = axis == 0 ? coverage.x : axis == 1 ? coverage.y : coverage.z;
    return c / 65535.0;
}

/// Occupied volume, scene units^3.
inline double occupied_volume(const VoxelSource& source) {
    double sum = 0.0;
    for_each_voxel(source, [&](const FoundVoxel& v) { sum += v.coverage.occupancy / 65535.0; });
    const Vec3d h = source.info().lattice.voxel_size;
    return sum * h.x * h.y * h.z;
}

} // namespace heddle::test
