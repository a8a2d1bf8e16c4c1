#include <heddle/voxelize/test_tube.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

using namespace heddle::test;

// The count of n subvoxels has a standard error below 1 / sqrt(n): 0.3 % for the 100,000 here.
constexpr double kSubvoxels = 1e5;

TEST(SolidVolume, StraightYarnsFillTheirVolume) {
    for (const double subvoxels : {0.5, 1.0, 4.0, 12.0}) {
        EXPECT_LT(std::fabs(volume_error(line(), 1.0, subvoxels, kSubvoxels)), 0.01) << subvoxels;
    }
}

TEST(SolidVolume, BentYarnsFillTheirVolume) {
    for (const double subvoxels : {0.5, 1.0, 4.0, 12.0}) {
        SCOPED_TRACE(testing::Message() << "radius " << subvoxels);
        const auto error = [&](const CurveSet& set) {
            return std::fabs(volume_error(set, 1.2, subvoxels, kSubvoxels));
        };
        EXPECT_LT(error(helix(12, Basis::CatmullRom)), 0.01);
        EXPECT_LT(error(helix(12, Basis::CubicBSpline)), 0.01);
        EXPECT_LT(error(helix(48, Basis::Linear)), 0.01);
        EXPECT_LT(error(circle(12, Basis::CatmullRom)), 0.01);
    }
}

TEST(SolidVolume, KnittedYarnsFillTheirVolume) {
    GenerateOptions options;
    options.nx = 4;
    options.ny = 4;
    const Geometry knit = generate(options);
    const double radius = static_cast<double>(knit.curves[0].default_radius);
    EXPECT_LT(std::fabs(volume_error(knit.curves[0], radius, 2.0, kSubvoxels)), 0.01);
    EXPECT_LT(std::fabs(volume_error(knit.curves[0], radius, 8.0, kSubvoxels)), 0.01);
}

} // namespace
} // namespace heddle
