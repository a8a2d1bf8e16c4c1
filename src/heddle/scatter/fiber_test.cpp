#include <heddle/scatter/scatterer.h>

#include <heddle/scatter/test_sphere.h>

#include <gtest/gtest.h>

#include <cmath>

namespace heddle {
namespace {

Scatterer lambert() {
    ScatterMaterial m;
    m.model = ScatterModel::LambertFiber;
    m.albedo = {1.0f, 0.5f, 0.0f};
    return test::askew(m);
}

Scatterer lobes(float width_r = .1f, float width_tt = .3f, float azimuth = .5f, float tilt = .05f) {
    ScatterMaterial m;
    m.model = ScatterModel::LobeFiber;
    m.color_r = {.3f, .2f, 0.0f};
    m.color_tt = {.7f, .1f, .4f};
    m.width_r = width_r;
    m.width_tt = width_tt;
    m.azimuth_tt = azimuth;
    m.tilt = tilt;
    return test::askew(m);
}

/// A direction at angle `theta` from the plane across the fiber.
Vec3f inclined(double theta, double turns = .1) {
    return test::Askew{}.world(test::direction(std::sin(theta), turns));
}

TEST(LambertFiber, ItsEnergyIsTheAlbedoForEveryDirection) {
    for (const double theta : {0.0, .4, 1.2, 1.56, -1.0}) {
        const test::Integral sum = test::integrate(lambert(), inclined(theta));
        EXPECT_NEAR(sum.energy[0], 1.0, 5e-4) << theta;
        EXPECT_NEAR(sum.energy[1], .5, 3e-4);
        EXPECT_EQ(sum.energy[2], 0.0);
    }
}

TEST(LambertFiber, IsTheMeanOverTheCylindersVisibleNormals) {
    const test::Askew f;
    const Vec3f wi = inclined(.5, .2);
    for (const Vec3f wo : {inclined(-.3, .25), inclined(.9, .6), inclined(0.0, .72)}) {
        double seen = 0.0;
        double lit = 0.0;
        constexpr int kNormals = 10000;
        for (int i = 0; i < kNormals; ++i) {
            const Vec3f n = f.world(test::direction(0.0, (i + .5) / kNormals));
            const auto facing = static_cast<double>(std::max(0.0f, dot(n, wi)));
            seen += facing;
            lit += facing * static_cast<double>(std::max(0.0f, dot(n, wo))) / test::kPi;
        }
        EXPECT_NEAR(static_cast<double>(evaluate(lambert(), wi, wo).x), lit / seen, 1e-5);
    }
}

TEST(LambertFiber, IsReciprocalOnceWeighedByTheProjectedArea) {
    const Scatterer at = lambert();
    CounterRandom random{12, 1};
    for (int i = 0; i < 50; ++i) {
        const Vec3f a = test::random_direction(random);
        const Vec3f b = test::random_direction(random);
        const float there = length(cross(a, at.axis)) * evaluate(at, a, b).x;
        const float back = length(cross(b, at.axis)) * evaluate(at, b, a).x;
        EXPECT_NEAR(there, back, 1e-5f);
    }
}

TEST(LambertFiber, SamplesFollowTheDensityAndWeighTheAlbedo) {
    for (const double theta : {0.0, 1.2, 1.5707}) {
        EXPECT_LT(test::chi_squared_z(lambert(), inclined(theta)), test::kUnlikely) << theta;
        const Vec3f weight = sample(lambert(), inclined(theta), {.2f, .7f, .4f}).weight;
        EXPECT_NEAR(weight.x, 1.0f, 1e-6f);
        EXPECT_NEAR(weight.y, .5f, 1e-6f);
    }
}

TEST(LobeFiber, ItsEnergyIsTheSumOfItsColours) {
    for (const float width : {.05f, .3f, 1.0f}) {
        for (const double theta : {0.0, .8, -1.5}) {
            const Scatterer at = lobes(width, width, width + .1f);
            const test::Integral sum = test::integrate(at, inclined(theta));
            EXPECT_NEAR(sum.energy[0], 1.0, 5e-3) << width << ' ' << theta;
            EXPECT_NEAR(sum.energy[1], .3, 2e-3);
            EXPECT_NEAR(sum.energy[2], .4, 2e-3);
            EXPECT_NEAR(sum.pdf, 1.0, 5e-3);
        }
    }
}

TEST(LobeFiber, NarrowLobesKeepTheirEnergyInTheirSamples) {
    const Vec3d weight = test::mean_weight(lobes(0.0f, .001f, .01f), inclined(.7));
    EXPECT_NEAR(weight.x, 1.0, .01);
    EXPECT_NEAR(weight.y, .3, .01);
}

TEST(LobeFiber, SamplesFollowTheDensity) {
    EXPECT_LT(test::chi_squared_z(lobes(), inclined(.3)), test::kUnlikely);
    EXPECT_LT(test::chi_squared_z(lobes(.2f, .5f, 2.0f, -.1f), inclined(-1.0)), test::kUnlikely);
    EXPECT_LT(test::chi_squared_z(lobes(.1f, .05f, .2f), inclined(1.4)), test::kUnlikely);
}

TEST(LobeFiber, WeightsOfTheTransmittedLobeStayNearItsColour) {
    Scatterer at = lobes();
    at.material.color_r = {};
    at.material.color_tt = {1, 1, 1};
    for (const float azimuth : {.05f, .3f, .7f, 1.0f}) {
        at.material.azimuth_tt = azimuth;
        CounterRandom random{12, 2};
        float most = 0.0f;
        for (int i = 0; i < 5000; ++i) {
            most = std::max(most, sample(at, inclined(.3), test::random_point(random)).weight.x);
        }
        EXPECT_LT(most, 1.8f) << azimuth;
        EXPECT_GT(most, .9f);
    }
}

TEST(LobeFiber, ReflectsIntoTheConeAndTransmitsForward) {
    const Scatterer at = lobes(.02f, .02f, .2f, 0.0f);
    const Vec3f wi = inclined(.5, .1);
    const auto green = [&](double theta, double turns) {
        return evaluate(at, wi, inclined(theta, turns)).y;
    };
    EXPECT_GT(green(-.5, .1), 50.0f * green(-.3, .1)); // the cone's inclination is mirrored
    const float blue_forward = evaluate(at, wi, inclined(-.5, .6)).z; // TT alone is blue
    EXPECT_GT(blue_forward, 1.0f);
    EXPECT_LT(evaluate(at, wi, inclined(-.5, .1)).z, 1e-3f * blue_forward);
}

} // namespace
} // namespace heddle
