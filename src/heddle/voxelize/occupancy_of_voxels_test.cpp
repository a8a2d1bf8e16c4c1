#include <heddle/voxel/occupancy.h>
#include <heddle/voxelize/test_cylinder.h>
#include <heddle/voxelize/test_swatch.h>
#include <heddle/voxelize/test_tube.h>

#include <gtest/gtest.h>

#include <bit>

namespace heddle {
namespace {

using namespace heddle::test;

VoxelizeOptions options_of(std::int64_t voxels, std::int32_t subvoxels = 8) {
    VoxelizeOptions options;
    options.voxels = voxels;
    options.subvoxels = subvoxels;
    options.spool_dir = testing::TempDir();
    return options;
}

TEST(VoxelOccupancy, ASubvoxelFillsAtLeastItsCellOrTheCellsThatItSpans) {
    for (const std::int32_t n : {1, 2, 4, 8}) {
        const auto level = voxelize_now(swatch(), options_of(120, n));
        ASSERT_TRUE(level->info().fields.occupancy);
        std::int64_t cells_set = 0;
        for_each_voxel(*level, [&](const BlockVoxel& v) {
            const int hits = (int{v.coverage().occupancy} * n * n * n + 32767) / 65535;
            const int cells = std::popcount(v.occupancy());
            cells_set += cells;
            if (n <= 4) {
                ASSERT_GE(cells * n * n * n, hits * 64) << n << " subvoxels";
            } else {
                ASSERT_GE(cells * 8, hits);
            }
        });
        EXPECT_GT(cells_set, 1000);
    }
}

/// Returns the bits that `has(x, y, z)` sets, in subvoxels from the voxel's corner.
template <typename Has>
std::uint64_t cells_where(Vec3i voxel, const Has& has) {
    std::uint64_t cells = 0;
    for (int i = 0; i < 512; ++i) {
        const Vec3i at{i / 64, i / 8 % 8, i % 8};
        if (!has(voxel * 8 + at)) continue;
        cells |= std::uint64_t{1} << ((at.x / 2 * 4 + at.y / 2) * 4 + at.z / 2);
    }
    return cells;
}

TEST(VoxelOccupancy, OfAFiberIsWhereTheFiberIs) {
    const ExactCylinder fiber{{3.0, -40.0, 11.0}, {71.0, 29.0, 50.0}, 6.3};
    CurveSet set;
    set.basis = Basis::Linear;
    add_curve(set, {to_float(fiber.from), to_float(fiber.to)});
    VoxelizeOptions options;
    options.voxel_size = {8.0, 8.0, 8.0};
    const auto level = voxelize_now(solid_yarns(set, fiber.radius), options);
    // a subvoxel is occupied where a centre line along z is inside the fiber
    const auto inside = [&](Vec3i at) { return depths_inside(fiber, 2, at.x + 0.5, at.y + 0.5); };
    int compared = 0;
    for_each_voxel(*level, [&](const BlockVoxel& v) {
        const std::uint64_t least = cells_where(v.at, [&](Vec3i at) {
            const Interval in = inside(at);
            return in.lo < at.z && in.hi > at.z + 1;
        });
        const std::uint64_t most = cells_where(v.at, [&](Vec3i at) {
            const Interval in = inside(at);
            return in.hi > in.lo && in.lo < at.z + 1.01 && in.hi > at.z - 0.01;
        });
        EXPECT_EQ(v.occupancy() & least, least);
        EXPECT_EQ(v.occupancy() | most, most);
        compared += std::popcount(least);
    });
    EXPECT_GT(compared, 500);
}

} // namespace
} // namespace heddle
