#include <heddle/device/deliver_blocks.h>

#include <heddle/device/voxelize_device.h>
#include <heddle/voxelize/test_swatch.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

using namespace heddle::test;

/// Expects the levels and correlation of the CPU, for a level 0 that was built by a device.
void expect_parity(const LodOptions& lod, bool correlation) {
    VoxelizeOptions options;
    options.voxels = 80;
    options.correlation = correlation;
    options.spool_dir = testing::TempDir();
    const VoxelizePlan plan = plan_voxelize(swatch(), options);
    Progress silent;
    LevelBuilder cpu(lod);
    auto level0 = voxelize(swatch(), options, plan, silent, &cpu);
    const VoxelLevels expected = cpu.finish(std::move(level0));
    LevelBuilder levels(lod);
    level0 = voxelize_on_host_executor(swatch(), options, plan, {}, silent, &levels);
    const VoxelLevels found = levels.finish(std::move(level0));
    ASSERT_EQ(found.size(), expected.size());
    ASSERT_GT(found.size(), 2u);
    for (std::size_t l = 0; l < found.size(); ++l) {
        ASSERT_EQ(found[l]->block_count(), expected[l]->block_count());
        VoxelBlock a, b;
        for (std::size_t i = 0; i < found[l]->block_count(); ++i) {
            expect_same_block(found[l]->block(i, a), expected[l]->block(i, b));
        }
    }
}

TEST(HandOver, LevelsOfOtherMethodsAreBuiltOfTheDevicesVoxels) {
    for (const LodMethod method : {LodMethod::Single, LodMethod::Naive, LodMethod::Random}) {
        expect_parity({.method = method, .max_levels = 3, .seed = 7}, false);
    }
}

TEST(HandOver, CorrelationIsFoundOfTheDevicesVoxels) {
    expect_parity({}, true);
}

TEST(HandOver, WithoutABuilderNoLevelsAndNoSumsAreMade) {
    FitOptions fit;
    fit.fields.footprints = 4;
    const BatchOptions settings = batch_options(fit, nullptr);
    EXPECT_EQ(settings.levels, 0);
    EXPECT_FALSE(settings.top);
    EXPECT_FALSE(settings.level0.fields.masks);
    EXPECT_EQ(settings.level0.fields.footprints, 4);
}

} // namespace
} // namespace heddle
