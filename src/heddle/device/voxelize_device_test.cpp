#include <heddle/device/voxelize_device.h>
#include <heddle/voxel/test_swatch.h>

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

/// The swatch with flyaways: hairs and loops.
Geometry hairy_swatch() {
    Geometry g = swatch();
    YarnType& y = g.yarns[0];
    y.flyaways = true;
    y.migration = true;
    y.migration_min = 0.5f;
    y.migration_frequency = 1.5f;
    y.hair_density = 3.0f;
    y.hair_ze = {0.5f, 0.2f};
    y.hair_r0 = {0.3f, 0.1f};
    y.hair_re = {0.4f, 0.1f};
    y.hair_pe = {0.5f, 0.2f};
    y.loop_density = 2.0f;
    y.loop_r1 = {0.8f, 0.2f};
    return g;
}

/// Expects that levels by the host executor hold what those of the CPU hold, level by level.
void expect_parity(const Geometry& geometry,
                   const VoxelizeOptions& options,
                   DeviceOptions device = {}) {
    const VoxelizePlan plan = plan_voxelize(geometry, options);
    Progress silent;
    LevelBuilder cpu_levels({});
    auto cpu = voxelize(geometry, options, plan, silent, &cpu_levels);
    const VoxelLevels expected = cpu_levels.finish(std::move(cpu));
    LevelBuilder levels({});
    auto level0 = voxelize_on_host_executor(geometry, options, plan, device, silent, &levels);
    const VoxelLevels found = levels.finish(std::move(level0));
    ASSERT_EQ(found.size(), expected.size());
    ASSERT_GT(expected[0]->info().voxel_count, 100);
    for (std::size_t l = 0; l < found.size(); ++l) {
        EXPECT_EQ(found[l]->info().voxel_count, expected[l]->info().voxel_count);
        ASSERT_EQ(found[l]->block_count(), expected[l]->block_count());
        VoxelBlock a, b;
        for (std::size_t i = 0; i < found[l]->block_count(); ++i) {
            expect_same_block(found[l]->block(i, a), expected[l]->block(i, b));
        }
    }
}

TEST(DeviceVoxelizer, YarnAndHairAreTheCpus) {
    for (const int subvoxels : {1, 2, 4, 8}) {
        VoxelizeOptions options = options_of(100);
        options.subvoxels = subvoxels;
        options.keep_sums = subvoxels == 4;
        options.footprints = subvoxels == 8 ? 4 : 0;
        expect_parity(hairy_swatch(), options);
    }
}

} // namespace
} // namespace heddle
