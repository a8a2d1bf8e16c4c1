#include <heddle/render/volume/fiber_start.h>

#include <heddle/render/volume/test_volume.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace heddle {
namespace {

using namespace heddle::testing;

TEST(FiberStart, OverlapIsTheMeanOverDirections) {
    for (const double x : {0.3, 1.0, 1.7, 5.0, 15.9, 16.1, 80.0}) {
        double sum = 0.0;
        constexpr int kSteps = 2000;
        for (int i = 0; i < kSteps; ++i) { // integral of max(0, 1 - t cos) from 0 to x
            const double c = std::cos(0.5 * std::numbers::pi * (i + 0.5) / kSteps);
            const double end = std::min(x, 1.0 / c);
            sum += end - 0.5 * c * end * end;
        }
        EXPECT_NEAR(static_cast<double>(integrate_overlap(static_cast<float>(x))), sum / kSteps,
                    2e-3 * x);
    }
}

/// One level with full cells and fibers of radius 0.01.
std::shared_ptr<const TraversalLevel> fiber_level() {
    VoxelMap voxels;
    for (int i = 0; i < 8; ++i) voxels[{i, 0, 0}] = even_voxel(0.5, {{needle({0, 0, 1}), 255, 0}});
    return level_with_cells(voxels, 0.01f, [](std::size_t) { return ~std::uint64_t{0}; });
}

TEST(FiberStart, TheWayBackIsFreeAsFarAsItIsKnown) {
    const auto level = fiber_level();
    const VoxelRay ray{{0.6, 0.6, 0.6}, {1, 0, 0}};
    const StartShade back(*level, ray, {0.01f, 1.0f, 5.0f}, 1.0f);
    EXPECT_EQ(back.depth_of(0.0f, 5.0f, 1.0f), 0.0f);
    EXPECT_NEAR(back.depth_of(0.0f, 7.0f, 1.0f), 2.0f, 1e-5f);
    const StartShade none(*level, ray, {}, 1.0f);
    EXPECT_NEAR(none.depth_of(0.0f, 7.0f, 1.0f), 7.0f, 1e-5f);
}

TEST(FiberStart, ShadeGrowsWithTheAngleToTheWayBack) {
    const auto level = fiber_level();
    const VoxelRay ray{{0.6, 0.6, 0.6}, {1, 0, 0}};
    float last = -1.0f;
    for (const float cosine : {1.0f, 0.99f, 0.9f, 0.5f, 0.0f}) {
        const StartShade shade(*level, ray, {0.01f, cosine, 100.0f}, 1.0f);
        const float depth = shade.depth_of(0.0f, 3.0f, 1.0f);
        EXPECT_GT(depth, last);
        EXPECT_LE(depth, 3.0f);
        last = depth;
    }
    EXPECT_GT(last, 2.6f);
}

TEST(FiberStart, TheFiberDoesNotStopItsOwnRay) {
    const auto level = fiber_level();
    const VoxelRay ray{{0.55, 0.6, 0.6}, {1, 0, 0}}; // leaves its cell at 0.2
    const StartShade shade(*level, ray, {0.01f, -1.0f, 0.0f}, 1.0f);
    const float own = 2.0f * 0.01f * 16.0f; // diameter over the section of a cell
    EXPECT_NEAR(shade.depth_of(0.0f, 0.5f, 1.0f), 0.49f - 0.19f * own, 1e-5f);
    EXPECT_NEAR(shade.depth_of(0.0f, 0.5f, 0.1f), 0.03f, 1e-5f); // nothing else is in the cell
}

} // namespace
} // namespace heddle
