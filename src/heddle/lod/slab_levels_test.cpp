#include <heddle/lod/build_levels.h>
#include <heddle/lod/rebuild_levels.h>
#include <heddle/voxel/parent_slab.h>
#include <heddle/voxelize/test_swatch.h>

#include <algorithm>
#include <cmath>

namespace heddle {
namespace {

using namespace heddle::test;

VoxelLevels build(const Geometry& geometry, const VoxelizeOptions& options, LodOptions lod = {}) {
    LevelBuilder builder(lod);
    Progress silent;
    const VoxelizePlan plan = plan_voxelize(geometry, options, silent, &builder);
    auto finest = voxelize(geometry, options, plan, silent, &builder);
    return builder.finish(std::move(finest));
}

VoxelizeOptions options_of(bool keep_sums) {
    VoxelizeOptions options;
    options.voxel_size = {0.05, 0.04, 0.06};
    options.keep_sums = keep_sums;
    options.spool_dir = testing::TempDir();
    return options;
}

/// The swatch, and a grid of 24 x 24 quads in waves through it.
Geometry waves() {
    constexpr std::uint32_t kEdge = 25;
    Geometry g = swatch();
    Mesh mesh;
    mesh.material = static_cast<std::uint32_t>(g.materials.size());
    g.materials.emplace_back();
    for (std::uint32_t i = 0; i < kEdge * kEdge; ++i) {
        const float x = static_cast<float>(i / kEdge) * 0.25f;
        const float y = static_cast<float>(i % kEdge) * 0.25f;
        mesh.positions.push_back({x, y, 0.8f * std::sin(x) * std::cos(1.3f * y)});
    }
    for (std::uint32_t i = 0; i + kEdge < kEdge * kEdge; ++i) {
        if (i % kEdge == kEdge - 1) continue;
        mesh.triangles.push_back({i, i + kEdge, i + 1});
        mesh.triangles.push_back({i + 1, i + kEdge, i + kEdge + 1});
    }
    g.meshes.push_back(std::move(mesh));
    return g;
}

bool is_surface(const VoxelLevel& level, const Content& voxel) {
    return level.info().materials[voxel.lobes.front().material].kind == MaterialKind::Surface;
}

/// Expects that the slabs of a level are those that the stored slabs of the level below give.
/// @return  number of voxels with a slab
int expect_joined(const VoxelLevel& below, const VoxelLevel& level) {
    const std::map<Key, Content> children = content_of(below);
    const Vec3d edges = level.info().lattice.voxel_size;
    const auto gradient_of = [&](const Content& voxel) {
        return slab_gradient(slab_normal(voxel.slab), edges);
    };
    int joined = 0;
    for (const auto& [at, voxel] : content_of(level)) {
        if (!is_surface(level, voxel)) {
            EXPECT_EQ(voxel.slab, PlaneSlab{});
            continue;
        }
        ++joined;
        ParentSlab expected{gradient_of(voxel)};
        for (int octant = 7; octant >= 0; --octant) {
            const auto [x, y, z] = at;
            const auto child = children.find(
                {2 * x + (octant >> 2), 2 * y + (octant >> 1 & 1), 2 * z + (octant & 1)});
            if (child == children.end() || !is_surface(below, child->second)) continue;
            expected.add(octant, gradient_of(child->second), child->second.slab);
        }
        EXPECT_EQ(voxel.slab, expected.slab(voxel.slab.normal)) << level.info().level;
    }
    return joined;
}

TEST(SlabLevels, AParentHoldsTheStoredSlabsOfItsChildren) {
    const Geometry g = waves();
    for (const LodMethod method : {LodMethod::Moments, LodMethod::Naive, LodMethod::Random}) {
        LodOptions lod;
        lod.method = method;
        const VoxelLevels levels = build(g, options_of(false), lod);
        ASSERT_GE(levels.size(), 7u) << "some are above the blocks";
        for (std::size_t l = 1; l < levels.size(); ++l) {
            EXPECT_TRUE(levels[l]->info().fields.slabs);
            const int joined = expect_joined(*levels[l - 1], *levels[l]);
            EXPECT_TRUE(joined > 30 || l >= 4) << l;
        }
    }
}

TEST(SlabLevels, AThinSurfaceStaysThin) {
    const VoxelLevels levels = build(waves(), options_of(false));
    for (std::size_t l = 0; l < 3; ++l) {
        std::vector<int> thickness;
        for (const auto& [at, voxel] : content_of(*levels[l])) {
            if (is_surface(*levels[l], voxel)) {
                thickness.push_back(voxel.slab.hi - voxel.slab.lo);
            }
        }
        std::sort(thickness.begin(), thickness.end());
        EXPECT_LT(thickness[thickness.size() / 2], 8 << l) << l;
    }
}

TEST(SlabLevels, LevelsThatAreBuiltAgainAreTheSame) {
    const Geometry g = waves();
    Progress silent;
    const VoxelLevels first = build(g, options_of(true));
    const VoxelLevels again = rebuild_levels(build(g, options_of(true)), {}, true, silent);
    ASSERT_EQ(again.size(), first.size());
    for (std::size_t l = 0; l < first.size(); ++l) {
        EXPECT_TRUE(content_of(*again[l]) == content_of(*first[l])) << l;
    }
    const VoxelLevels stored = rebuild_levels(build(g, options_of(false)), {}, false, silent);
    for (std::size_t l = 1; l < stored.size(); ++l) {
        EXPECT_TRUE(stored[l]->info().fields.slabs);
        expect_joined(*stored[l - 1], *stored[l]);
    }
}

} // namespace
} // namespace heddle
