#include <heddle/io/vol/vol_medium.h>

#include <heddle/sggx/pack.h>

#include <gtest/gtest.h>

#include <cmath>

namespace heddle {
namespace {

double depth_of(std::uint16_t coverage) {
    return -std::log1p(-static_cast<double>(coverage) / 65535.0);
}

TEST(VolMedium, WithoutDirectionExtinctionIsDensityTimesScale) {
    const Vec3d h{0.5, 1.0, 2.0};
    const Coverage c = VolMedium(h, 0.6).coverage(0.5f, {});
    EXPECT_NEAR(depth_of(c.x), 0.15, 2e-5);
    EXPECT_NEAR(depth_of(c.y), 0.3, 2e-5);
    EXPECT_NEAR(depth_of(c.z), 0.6, 4e-5);
}

TEST(VolMedium, AlongAFiberNothingIsHiddenAndAcrossItFourOverPi) {
    const double pi = std::acos(-1.0);
    const VolMedium medium({1.0, 1.0, 1.0}, 1.0);
    const Coverage c = medium.coverage(1.0f, {0.0f, 0.0f, 1.0f});
    EXPECT_EQ(c.z, 0);
    EXPECT_NEAR(depth_of(c.x), 4.0 / pi, 1e-4);
    EXPECT_EQ(c.x, c.y);
    const Coverage tilted = medium.coverage(1.0f, {0.6f, 0.0f, 0.8f});
    EXPECT_NEAR(depth_of(tilted.x), 0.8 * 4.0 / pi, 1e-4);
    EXPECT_NEAR(depth_of(tilted.z), 0.6 * 4.0 / pi, 1e-4);
}

TEST(VolMedium, TheMeanOverAllDirectionsOfAFiberIsThatOfAnIsotropicMedium) {
    // mean of sin over the sphere is pi / 4: the factor 4 / pi keeps the mean extinction
    const VolMedium medium({1.0, 1.0, 1.0}, 0.1);
    double sum = 0.0;
    constexpr int kSteps = 2000;
    for (int i = 0; i < kSteps; ++i) {
        const double z = (i + 0.5) / kSteps;
        const double r = std::sqrt(1.0 - z * z);
        sum += depth_of(medium.coverage(1.0f, to_float({r, 0.0, z})).z);
    }
    EXPECT_NEAR(sum / kSteps, 0.1, 1e-4);
}

TEST(VolMedium, CoverageIsCappedBelowOne) {
    const Coverage c = VolMedium({1.0, 1.0, 1.0}, 1e6).coverage(1.0f, {});
    EXPECT_EQ(c.x, static_cast<std::uint16_t>(std::lround(65535.0 * 127.0 / 128.0)));
    EXPECT_EQ(c.occupancy, 65535);
}

TEST(VolMedium, OccupancyIsWhatEightSubvoxelsInARowMustHaveToHideAColumn) {
    const Coverage c = VolMedium({1.0, 1.0, 1.0}, 0.7).coverage(1.0f, {});
    const double missed = 1.0 - static_cast<double>(c.occupancy) / 65535.0;
    EXPECT_NEAR(1.0 - std::pow(missed, 8), static_cast<double>(c.x) / 65535.0, 1e-4);
}

TEST(VolMedium, ALobeIsANeedleAlongTheTangentOrUniform) {
    for (const Vec3f t : {Vec3f{1.0f, 0.0f, 0.0f}, Vec3f{0.0f, 0.6f, 0.8f},
                          Vec3f{0.48f, -0.64f, 0.6f}, Vec3f{-0.36f, 0.48f, 0.8f}}) {
        const PackedSggx lobe = VolMedium::lobe(t);
        EXPECT_TRUE(is_positive_definite(lobe));
        const SggxMatrix S = unpack(lobe);
        EXPECT_NEAR(projected_area(S, t), 1.0f, 0.01f);
        EXPECT_LT(projected_area(S, any_perpendicular(t)), 0.12f);
        EXPECT_EQ(lobe, VolMedium::lobe(t * -1.0f));
    }
    const SggxMatrix S = unpack(VolMedium::lobe({}));
    EXPECT_NEAR(projected_area(S, {1.0f, 0.0f, 0.0f}), 0.5f, 0.01f);
    EXPECT_NEAR(projected_area(S, {0.0f, 0.6f, 0.8f}), 0.5f, 0.01f);
}

TEST(VolMedium, TheDefaultScaleHides86PercentOfAVoxelsFace) {
    const Vec3d h{0.02, 0.02, 0.02};
    EXPECT_NEAR(default_density_scale(h), 100.0, 1e-9);
    const Coverage c = VolMedium(h, default_density_scale(h)).coverage(1.0f, {});
    EXPECT_NEAR(static_cast<double>(c.x) / 65535.0, 0.8647, 1e-4);
}

} // namespace
} // namespace heddle
