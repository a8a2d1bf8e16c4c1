#include <heddle/voxelize/test_isolated.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

using namespace heddle::test;

// It is random which columns' centres a fiber hits, so the error varies from fiber to fiber. Four
// standard errors of its mean are allowed, and 0.1 % of a systematic part. `most` bounds the sum,
// so that the variance cannot hide an error. bench/results/exact.md has the full-size figures.
void expect_exact(const IsolatedOptions& options, double most) {
    const IsolatedResult result = IsolatedFibers(options).measure();
    for (std::size_t a = 0; a < 3; ++a) {
        SCOPED_TRACE(testing::Message() << "diameter " << options.diameter << ", axis " << a);
        const CoverageTally& all = result.axis[a];
        EXPECT_EQ(all.fibers, options.count);
        EXPECT_LT(std::fabs(all.error()), 0.001 + 4.0 * all.deviation());
        EXPECT_LT(std::fabs(all.error()), most);
        for (const CoverageTally& t : result.angle[a]) {
            if (t.fibers < 8) continue; // too few to estimate their variance
            EXPECT_LT(std::fabs(t.error()), 0.002 + 4.5 * t.deviation()) << t.fibers << " fibers";
        }
    }
}

TEST(FiberCoverage, ThinFibersCoverTheirProjectionInTheMean) {
    expect_exact({.diameter = 0.1, .count = 500}, 0.02);
    expect_exact({.diameter = 0.3, .count = 300}, 0.01);
}

TEST(FiberCoverage, ThickFibersCoverTheirProjection) {
    expect_exact({.diameter = 1.0, .count = 150}, 0.005);
    expect_exact({.diameter = 4.0, .count = 60}, 0.002);
    expect_exact({.diameter = 16.0, .count = 20}, 0.002);
}

TEST(FiberCoverage, VoxelsNeedNotBeCubes) {
    expect_exact({.diameter = 1.0, .count = 150, .length = 40.0, .voxel_size = {1.0, 0.5, 0.2}},
                 0.02);
    expect_exact({.diameter = 6.0, .count = 40, .length = 40.0, .voxel_size = {0.3, 1.0, 0.6}},
                 0.005);
}

} // namespace
} // namespace heddle
