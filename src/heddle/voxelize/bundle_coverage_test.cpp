#include <heddle/voxelize/test_bundle.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

using namespace heddle::test;

// The error of a face has a standard deviation of about 0.02, and a bundle has over 300 faces, so
// the bias of four bundles is known within 0.0006. The bounds are those that the voxelizer
// promises.
void expect_near_rays(Bundle (*make)(const BundleOptions&), BundleOptions options) {
    BundleError error;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        options.seed = seed;
        const Bundle bundle = make(options);
        VoxelizeOptions voxels;
        voxels.voxel_size = {1.0, 1.0, 1.0};
        compare(*voxelize_now(bundle.geometry, voxels), cast_rays(bundle), error);
    }
    SCOPED_TRACE(testing::Message() << "fill " << options.fill << ", " << error.faces << " faces");
    EXPECT_GT(error.faces, 1000);
    EXPECT_GT(error.mean_coverage(), 0.2);
    EXPECT_LT(std::fabs(error.bias()), 0.005);
    EXPECT_LT(error.mean_absolute(), 0.025);
}

TEST(BundleCoverage, StraightBundlesCoverWhatRaysThroughThemFind) {
    expect_near_rays(straight_bundle, {.radius = 10.0, .fill = 0.2});
    expect_near_rays(straight_bundle, {.radius = 10.0, .fill = 0.6});
}

TEST(BundleCoverage, YarnsCoverWhatRaysThroughTheirFibersFind) {
    expect_near_rays(yarn_bundle, {.radius = 10.0, .fill = 0.2, .slope = 0.35});
    expect_near_rays(yarn_bundle, {.radius = 10.0, .fill = 0.6, .slope = 0.35});
}

TEST(BundleCoverage, AFewThickFibersCoverWhatRaysFind) {
    expect_near_rays(straight_bundle, {.radius = 16.0, .fill = 0.5, .fibers = 12});
}

} // namespace
} // namespace heddle
