#include <heddle/scatter/scatterer.h>

#include <heddle/scatter/test_sphere.h>
#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>
#include <heddle/sggx/sample.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

/// Flakes with these second moments along the askew axes, packed as a voxel stores them.
Scatterer flakes(Vec3f moments, ScatterModel model = ScatterModel::MicroflakeSpecular) {
    ScatterMaterial m;
    m.model = model;
    m.albedo = {1.0f, 0.5f, 0.25f};
    Scatterer at = test::askew(m);
    const test::Askew f;
    const auto d = [](Vec3f v) { return to_double(v); };
    at.lobe = unpack(
        pack(fit_sggx(compose({{static_cast<double>(moments.x), static_cast<double>(moments.y),
                                static_cast<double>(moments.z)},
                               {d(f.x), d(f.y), d(f.z)}}))));
    return at;
}

const Vec3f kMoments[] = {{1, 1, 1}, {1, .5f, .1f}, {.05f, 1, .05f}, {1, 1, .03f}};

TEST(MicroflakeSpecular, ItsEnergyIsTheAlbedoForEveryLobeAndDirection) {
    CounterRandom random{11, 1};
    for (const Vec3f& m : kMoments) {
        const Scatterer at = flakes(m);
        for (int i = 0; i < 3; ++i) {
            const test::Integral sum = test::integrate(at, test::random_direction(random));
            EXPECT_NEAR(sum.energy[0], 1.0, 3e-3) << m.y << ' ' << m.z;
            EXPECT_NEAR(sum.energy[1], 0.5, 2e-3);
            EXPECT_NEAR(sum.pdf, 1.0, 3e-3);
        }
    }
}

TEST(MicroflakeSpecular, SamplesFollowTheDensityAndWeighTheAlbedo) {
    CounterRandom random{11, 2};
    for (const Vec3f& m : kMoments) {
        const Scatterer at = flakes(m);
        const Vec3f wi = test::random_direction(random);
        EXPECT_LT(test::chi_squared_z(at, wi), test::kUnlikely) << m.y << ' ' << m.z;
        const ScatterSample s = sample(at, wi, {.3f, .6f, .1f});
        EXPECT_NEAR(s.weight.x, 1.0f, 1e-5f);
        EXPECT_NEAR(s.weight.z, 0.25f, 1e-5f);
    }
}

TEST(MicroflakeSpecular, IsReciprocalOnceWeighedByTheProjectedArea) {
    CounterRandom random{11, 3};
    const Scatterer at = flakes({1, .5f, .1f});
    for (int i = 0; i < 50; ++i) {
        const Vec3f a = test::random_direction(random);
        const Vec3f b = test::random_direction(random);
        const float there = projected_area(at.lobe, a) * evaluate(at, a, b).x;
        const float back = projected_area(at.lobe, b) * evaluate(at, b, a).x;
        EXPECT_NEAR(there, back, 1e-4f * there);
    }
}

TEST(MicroflakeSpecular, ANeedleOfNormalsIsAMirrorAndSaysSo) {
    Scatterer at = flakes({0, 0, 1});
    const test::Askew f;
    const Vec3f wi = f.world({.6f, 0, .8f});
    const ScatterSample sharp = sample(at, wi, {.5f, .3f, .2f});
    EXPECT_GT(dot(sharp.direction, f.world({-.6f, 0, .8f})), .999f);
    EXPECT_LT(sharp.roughness, .05f);
    EXPECT_GT(sample(flakes({1, 1, 1}), wi, {.5f, .3f, .2f}).roughness, .9f);
}

TEST(MicroflakeSpecular, ALobeOfNothingAbsorbs) {
    Scatterer at = flakes({1, 1, 1});
    at.lobe = {};
    const ScatterSample s = sample(at, {0, 0, 1}, {.5f, .5f, .5f});
    EXPECT_EQ(s.pdf, 0.0f);
    EXPECT_EQ(s.weight, Vec3f{});
}

TEST(MicroflakeDiffuse, ItsEnergyIsTheAlbedoAndSamplesFollowTheDensity) {
    const Scatterer at = flakes({1, 1, 1}, ScatterModel::MicroflakeDiffuse);
    const Vec3f wi = test::Askew{}.world({.6f, 0, .8f});
    const test::Integral sum = test::integrate(at, wi);
    EXPECT_NEAR(sum.energy[0], 1.0, 1e-4);
    EXPECT_NEAR(sum.energy[2], .25, 1e-4);
    EXPECT_NEAR(sum.pdf, 1.0, 1e-4);
    EXPECT_LT(test::chi_squared_z(at, wi), test::kUnlikely);
    EXPECT_EQ(evaluate(at, wi, at.axis * -1.0f), Vec3f{});
}

TEST(MicroflakeDiffuse, AveragedOverTheNormalsSeenItSendsAllOut) {
    // as a caller does: draw the normal that wi sees, then scatter about it
    Scatterer at = flakes({1, .5f, .1f}, ScatterModel::MicroflakeDiffuse);
    const Vec3f wi = test::Askew{}.world({.48f, .6f, .64f});
    const SggxFactor A = factor(at.lobe);
    CounterRandom random{11, 4};
    double back = 0.0;
    constexpr int kSamples = 20000;
    for (int i = 0; i < kSamples; ++i) {
        at.axis = sample_vndf(A, wi, random);
        const ScatterSample s = sample(at, wi, test::random_point(random));
        EXPECT_NEAR(s.weight.x, 1.0f, 1e-5f);
        back += static_cast<double>(dot(s.direction, wi)) / kSamples;
    }
    EXPECT_GT(back, 0.3); // diffuse flakes scatter back, specular ones of a sphere evenly
}

} // namespace
} // namespace heddle
