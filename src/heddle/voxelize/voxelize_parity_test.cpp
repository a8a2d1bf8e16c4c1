#include <heddle/base/parallel.h>
#include <heddle/voxelize/prepare.h>
#include <heddle/voxelize/test_swatch.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

using namespace heddle::test;

VoxelizeOptions options_of(std::int64_t voxels) {
    VoxelizeOptions options;
    options.voxels = voxels;
    options.seed = 5;
    options.spool_dir = testing::TempDir();
    return options;
}

TEST(VoxelizeParity, AnyNumberOfThreadsGivesTheSameBits) {
    set_thread_count(1);
    const std::map<Key, Content> one = content_of(*voxelize_now(swatch(), options_of(150)));
    set_thread_count(2);
    const std::map<Key, Content> two = content_of(*voxelize_now(swatch(), options_of(150)));
    set_thread_count(0);
    EXPECT_GT(one.size(), 10000u);
    EXPECT_TRUE(one == two);
}

TEST(VoxelizeParity, BatchesAndTheSpoolGiveTheSameBits) {
    const VoxelizeOptions options = options_of(150);
    VoxelizePlan plan = plan_voxelize(swatch(), options);
    plan.batches = 1;
    plan.spool = false;
    Progress silent;
    const std::map<Key, Content> whole = content_of(*voxelize(swatch(), options, plan, silent));
    plan.batches = 7;
    plan.spool = true;
    EXPECT_TRUE(whole == content_of(*voxelize(swatch(), options, plan, silent)));
}

TEST(VoxelizeParity, AMemoryLimitIsPlannedForAndGivesTheSameBits) {
    VoxelizeOptions options = options_of(300);
    options.memory_bytes = std::int64_t{8} << 30;
    const VoxelizePlan roomy = plan_voxelize(swatch(), options);
    EXPECT_FALSE(roomy.spool);
    Progress silent;
    const std::map<Key, Content> whole = content_of(*voxelize(swatch(), options, roomy, silent));
    // so much less that the result (at least 8 bytes per voxel) does not fit in addition to the
    // work
    options.memory_bytes = roomy.peak_bytes - roomy.voxels * 8;
    const VoxelizePlan tight = plan_voxelize(swatch(), options);
    EXPECT_TRUE(tight.spool);
    EXPECT_LE(tight.peak_bytes, options.memory_bytes);
    EXPECT_TRUE(whole == content_of(*voxelize(swatch(), options, tight, silent)));
}

TEST(VoxelizeParity, APlanHandsOnWhatItPreparedOnceAndServesAnyRun) {
    const VoxelizeOptions options = options_of(60);
    const VoxelizePlan plan = plan_voxelize(swatch(), options);
    VoxelizeOptions other_seed = options;
    other_seed.seed = 6;
    Progress silent;
    const std::map<Key, Content> first = content_of(*voxelize(swatch(), options, plan, silent));
    EXPECT_EQ(plan.prepared->take(), nullptr) << "it is not in memory after a run";
    EXPECT_TRUE(first == content_of(*voxelize(swatch(), options, plan, silent)));

    const VoxelizePlan of_other = plan_voxelize(swatch(), other_seed);
    EXPECT_TRUE(first == content_of(*voxelize(swatch(), options, of_other, silent)));
    const Geometry copy = swatch();
    const VoxelizePlan again = plan_voxelize(swatch(), options);
    EXPECT_TRUE(first == content_of(*voxelize(copy, options, again, silent)));
}

TEST(VoxelizeParity, ARegionGivesTheVoxelsOfTheWhole) {
    VoxelizeOptions options = options_of(0);
    const Bounds box = plan_voxelize(swatch(), options_of(150)).bounds;
    const double h = box.size().x / 120.0;
    options.voxel_size = {h, h, 1.5 * h};
    const std::map<Key, Content> whole = content_of(*voxelize_now(swatch(), options));
    Bounds region;
    region.grow(box.lo + box.size() * 0.3);
    region.grow(box.lo + box.size() * 0.75);
    options.bounds = region;
    const std::map<Key, Content> part = content_of(*voxelize_now(swatch(), options));
    const auto inside = [&](const Key& key) {
        const auto [x, y, z] = key;
        const Vec3d edge = options.voxel_size;
        const Vec3d lo = Vec3d{double(x), double(y), double(z)} * edge;
        for (int a = 0; a < 3; ++a) {
            if (lo[a] < region.lo[a] || lo[a] + edge[a] > region.hi[a]) return false;
        }
        return true;
    };
    std::size_t compared = 0;
    for (const auto& [key, content] : whole) {
        if (!inside(key)) continue;
        ++compared;
        const auto found = part.find(key);
        ASSERT_TRUE(found != part.end());
        ASSERT_TRUE(found->second == content);
    }
    EXPECT_GT(compared, 1000u);
    EXPECT_LT(part.size(), whole.size() / 2);
    for (const auto& [key, content] : part) EXPECT_EQ(whole.count(key), 1u);
}

TEST(VoxelizePlan, CurvesOfASurfacesMaterialAreRefused) {
    CurveSet set;
    heddle::test::add_curve(set, {{-2, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {2, 0, 0}});
    set.default_radius = 0.2f;
    Geometry geometry = heddle::test::geometry_of(set);
    EXPECT_GT(plan_voxelize(geometry, {}).voxels, 0);
    geometry.materials[0].name = "plastic";
    geometry.materials[0].kind = MaterialKind::Surface;
    try {
        (void)plan_voxelize(geometry, {});
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::InvalidArgument);
        EXPECT_STREQ(e.what(), "voxelize: curves of 'test' have the material 'plastic' of a "
                               "surface; set the material's kind to fiber");
    }
}

TEST(VoxelizePlan, ABoxOfTooManyBlocksIsRefusedBeforeItsCountersAreTaken) {
    Geometry geometry;
    geometry.name = "diagonal";
    geometry.materials.resize(1);
    geometry.materials[0].kind = MaterialKind::Fiber;
    CurveSet set;
    set.basis = Basis::Linear;
    set.points = {{0.0f, 0.0f, 0.0f}, {1e5f, 1e5f, 0.0f}};
    set.first = {0, 2};
    set.default_radius = 0.01f;
    geometry.curves.push_back(set);
    VoxelizeOptions options;
    options.voxel_size = {0.2, 0.2, 0.2};
    options.memory_bytes = std::int64_t{512} << 20; // the counters alone take 980 MB
    try {
        static_cast<void>(plan_voxelize(geometry, options));
        FAIL() << "planned";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::OutOfMemory);
        EXPECT_NE(std::string(e.what()).find("blocks"), std::string::npos) << e.what();
    }
}

} // namespace
} // namespace heddle
