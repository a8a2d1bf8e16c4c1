#include <heddle/lod/build_levels.h>
#include <heddle/lod/lookup.h>
#include <heddle/voxel/test_grid.h>
#include <heddle/voxelize/test_swatch.h>

#include <limits>
#include <set>

namespace heddle {
namespace {

using namespace heddle::test;

VoxelLevels build(bool moved) {
    Geometry geometry = swatch();
    if (moved) { // wholly at negative indices
        for (CurveSet& set : geometry.curves) {
            for (Vec3f& p : set.points) p = p - Vec3f{50, 60, 70};
        }
    }
    VoxelizeOptions options;
    options.voxels = 100;
    options.footprints = 4;
    options.spool_dir = ::testing::TempDir();
    LodOptions lod;
    LevelBuilder builder(lod);
    Progress silent;
    const VoxelizePlan plan = plan_voxelize(geometry, options, silent, &builder);
    return builder.finish(voxelize(geometry, options, plan, silent, &builder));
}

const VoxelLevels& pyramid(bool moved) {
    static const std::array<VoxelLevels, 2> both{build(false), build(true)};
    return both[moved ? 1 : 0];
}

Vec3d center_of(Vec3i at, const Lattice& lattice) {
    const Vec3d half{0.5, 0.5, 0.5};
    return (Vec3d{double(at.x), double(at.y), double(at.z)} + half) * lattice.voxel_size;
}

TEST(LevelWeights, SumToOneAreNeverNegativeAndNameLevelsThatAreThere) {
    for (const int count : {1, 2, 7}) {
        for (float level = -3.0f; level < 10.0f; level += 0.03125f) {
            const LevelWeights w = weights_of_level(level, count);
            EXPECT_EQ(w.floor_weight + w.ceiling_weight, 1.0f);
            EXPECT_GE(w.floor_weight, 0.0f);
            EXPECT_GE(w.ceiling_weight, 0.0f);
            EXPECT_GE(w.floor, 0);
            EXPECT_LE(w.floor, w.ceiling);
            EXPECT_LT(w.ceiling, count);
            const float inside = std::clamp(level, 0.0f, static_cast<float>(count - 1));
            EXPECT_FLOAT_EQ(static_cast<float>(w.floor) * w.floor_weight +
                                static_cast<float>(w.ceiling) * w.ceiling_weight,
                            inside);
        }
    }
}

TEST(LevelWeights, AreContinuousAtWholeLevels) {
    const auto weight_of = [](float level, int of) {
        const LevelWeights w = weights_of_level(level, 6);
        return (w.floor == of ? w.floor_weight : 0.0f) +
               (w.ceiling == of && w.ceiling != w.floor ? w.ceiling_weight : 0.0f);
    };
    for (int whole = 0; whole < 6; ++whole) {
        const auto level = static_cast<float>(whole);
        EXPECT_EQ(weight_of(level, whole), 1.0f);
        EXPECT_NEAR(weight_of(level - 1e-4f, whole), 1.0f, 2e-4f);
        EXPECT_NEAR(weight_of(level + 1e-4f, whole), 1.0f, 2e-4f);
    }
}

TEST(LevelWeights, WhatIsNoNumberIsTheFinestAndInfinityTheCoarsest) {
    EXPECT_EQ(weights_of_level(std::numeric_limits<float>::quiet_NaN(), 5).ceiling, 0);
    EXPECT_EQ(weights_of_level(-std::numeric_limits<float>::infinity(), 5).ceiling, 0);
    EXPECT_EQ(weights_of_level(std::numeric_limits<float>::infinity(), 5).floor, 4);
}

TEST(LevelWeights, AFootprintAsWideAsAVoxelOfALevelGivesThatLevel) {
    for (int level = 0; level < 8; ++level) {
        EXPECT_EQ(level_of_footprint(std::ldexp(0.3f, level), 0.3f), static_cast<float>(level));
    }
    EXPECT_EQ(weights_of_level(level_of_footprint(0.1f, 0.3f), 8).floor_weight, 1.0f);
    EXPECT_EQ(weights_of_level(level_of_footprint(0.0f, 0.3f), 8).ceiling, 0);
}

TEST(LevelLookup, FindsEveryVoxelOfEveryLevelAndNoOther) {
    for (const bool moved : {false, true}) {
        const VoxelLevels& levels = pyramid(moved);
        ASSERT_GE(levels.size(), 5u);
        const LevelLookup lookup(levels);
        ASSERT_EQ(lookup.level_count(), static_cast<int>(levels.size()));
        for (int l = 0; l < lookup.level_count(); ++l) {
            const Lattice lattice = levels[static_cast<std::size_t>(l)]->info().lattice;
            std::set<Key> there;
            for_each_voxel(*levels[static_cast<std::size_t>(l)], [&](const FoundVoxel& v) {
                there.emplace(v.at.x, v.at.y, v.at.z);
                EXPECT_TRUE(!moved || (v.at.x < 0 && v.at.y < 0 && v.at.z < 0));
                const auto found = lookup.find(l, center_of(v.at, lattice));
                ASSERT_TRUE(found);
                EXPECT_EQ(*found->coverage, v.coverage);
                EXPECT_TRUE(std::equal(v.lobes.begin(), v.lobes.end(), found->lobes.begin(),
                                       found->lobes.end()));
                EXPECT_TRUE(std::equal(v.maps.begin(), v.maps.end(), found->maps.begin(),
                                       found->maps.end()));
                EXPECT_EQ(found->merge_order, v.merge_order);
                ASSERT_NE(found->footprints, nullptr);
                EXPECT_EQ(*found->footprints, v.footprints);
                EXPECT_EQ(found->correlation, nullptr);
            });
            int empty = 0;
            for (const auto& [x, y, z] : there) {
                for (const Vec3i next : {Vec3i{x + 1, y, z}, {x, y - 1, z}, {x, y, z + 1}}) {
                    if (there.contains({next.x, next.y, next.z})) continue;
                    ++empty;
                    EXPECT_FALSE(lookup.find(l, center_of(next, lattice)));
                }
            }
            EXPECT_GT(empty, 0);
        }
    }
}

TEST(LevelLookup, GivesNothingOutside) {
    const LevelLookup lookup(pyramid(false));
    const double inf = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Vec3d p :
         {Vec3d{1e6, 0, 0}, {-1e6, 3, 3}, {0, 1e300, 0}, {inf, 0, 0}, {0, -inf, 0}, {0, 0, nan}}) {
        EXPECT_FALSE(lookup.find(0, p));
        const LevelSample sample = lookup.sample(p, 1.5f);
        EXPECT_FALSE(sample.floor || sample.ceiling);
        EXPECT_EQ(sample.weights.floor, 1);
    }
}

TEST(LevelLookup, AnEmptyVolumeHasNothingAnywhere) {
    VoxelLevels levels;
    levels.push_back(std::make_unique<VoxelGrid>());
    EXPECT_FALSE(LevelLookup(levels).find(0, {0, 0, 0}));
}

TEST(LevelLookup, AFaceBelongsToTheVoxelOfTheHigherIndex) {
    auto grid = std::make_unique<VoxelGrid>();
    grid->about.lattice.voxel_size = {0.5, 0.25, 0.5};
    const std::vector<Lobe> lobe(1);
    grid->blocks = heddle::testing::make_blocks(
        {{{-1, 0, -9}, {{1, 0, 0, 0}, lobe}}, {{0, 0, -9}, {{2, 0, 0, 0}, lobe}}});
    VoxelLevels levels;
    levels.push_back(std::move(grid));
    const LevelLookup lookup(levels);
    const auto covered_at = [&](Vec3d p) { return int{lookup.find(0, p)->coverage->x}; };
    EXPECT_EQ(covered_at({0.0, 0.1, -4.5}), 2);
    EXPECT_EQ(covered_at({-1e-12, 0.1, -4.5}), 1);
    EXPECT_EQ(covered_at({-0.5, 0.0, -4.0 - 1e-12}), 1);
    EXPECT_FALSE(lookup.find(0, {0.0, 0.25, -4.5}));
    EXPECT_FALSE(lookup.find(0, {0.0, 0.1, -4.0}));
}

TEST(LevelLookup, ASampleIsTheVoxelsOfBothLevels) {
    const VoxelLevels& levels = pyramid(true);
    const LevelLookup lookup(levels);
    for_each_voxel(*levels[0], [&](const FoundVoxel& v) {
        const Vec3d p = center_of(v.at, levels[0]->info().lattice);
        const LevelSample between = lookup.sample(p, 2.25f);
        ASSERT_TRUE(between.floor && between.ceiling);
        EXPECT_EQ(between.floor->coverage, lookup.find(2, p)->coverage);
        EXPECT_EQ(between.ceiling->coverage, lookup.find(3, p)->coverage);
        EXPECT_EQ(between.weights.ceiling_weight, 0.25f);
        const LevelSample whole = lookup.sample(p, 1.0f);
        EXPECT_EQ(whole.floor->coverage, whole.ceiling->coverage);
    });
}

} // namespace
} // namespace heddle
