#include <heddle/scatter/scatterer.h>

#include <heddle/scatter/surface_albedo.h>
#include <heddle/scatter/test_sphere.h>

#include <gtest/gtest.h>

#include <cmath>

namespace heddle {
namespace {

Scatterer surface(float roughness, float metalness, float anisotropy = 0.0f) {
    ScatterMaterial m;
    m.albedo = {1, 1, 1};
    m.roughness = roughness;
    m.metalness = metalness;
    m.anisotropy = anisotropy;
    return test::askew(m);
}

/// A direction with this cosine to the normal, `turns` from the tangent.
Vec3f from(double cosine, double turns = .1) {
    return test::Askew{}.world(test::direction(cosine, turns));
}

TEST(Surface, WhiteKeepsAllLightAtEveryRoughnessAndAnisotropy) {
    for (const float metalness : {0.0f, 1.0f}) {
        for (const float roughness : {.3f, .5f, .77f, 1.0f}) {
            for (const float anisotropy : {0.0f, .5f, .9f}) {
                for (const double cosine : {1.0, .5, .15}) {
                    const auto sum = test::integrate(surface(roughness, metalness, anisotropy),
                                                     from(cosine, .13), 192);
                    EXPECT_NEAR(sum.energy[0], 1.0, .015)
                        << metalness << ' ' << roughness << ' ' << anisotropy << ' ' << cosine;
                }
            }
        }
    }
}

TEST(Surface, SharpWhiteKeepsAllLightInItsSamples) {
    for (const float metalness : {0.0f, 1.0f}) {
        for (const float roughness : {0.0f, .05f, .15f}) {
            for (const float anisotropy : {0.0f, .3f, 1.0f}) {
                for (const double cosine : {1.0, .4, .12, .03}) {
                    const Scatterer at = surface(roughness, metalness, anisotropy);
                    const double bound = anisotropy > 0.0f && cosine < .1 ? .04 : .015;
                    EXPECT_NEAR(test::mean_weight(at, from(cosine, .13)).x, 1.0, bound)
                        << metalness << ' ' << roughness << ' ' << anisotropy << ' ' << cosine;
                }
            }
        }
    }
}

struct TableError {
    double worst = 0.0, worst_grazing = 0.0, mean = 0.0;
};

/// The error of the table against its integral; grazing means a cosine of 0.02 to 0.1.
TableError error_of_table(bool stretched) {
    CounterRandom random{13, 1};
    TableError e;
    constexpr int kTries = 600;
    for (int i = 0; i < kTries; ++i) {
        const float roughness = random.uniform();
        const float anisotropy = stretched ? random.uniform() : 0.0f;
        const double z = .02 + .98 * static_cast<double>(random.uniform()) * (i % 2 ? 1.0 : .1);
        const Vec3f wi = test::direction(z, static_cast<double>(random.uniform()));
        const auto table = detail::specular_albedo(roughness, anisotropy, wi);
        const auto sum =
            detail::integrate_specular_albedo(detail::alphas_of(roughness, anisotropy), wi, 2000);
        const auto error = static_cast<double>(
            std::max(std::fabs(table.all / sum.all - 1.0f), std::fabs(table.edge - sum.edge)));
        double& worst = z < .1 ? e.worst_grazing : e.worst;
        worst = std::max(worst, error);
        e.mean += error / kTries;
    }
    return e;
}

TEST(Surface, TheTablesOfAlbedosAreNearTheirIntegral) {
    const TableError round = error_of_table(false);
    EXPECT_LT(round.worst, .006);
    EXPECT_LT(round.worst_grazing, .02);
    EXPECT_LT(round.mean, .0015);
    const TableError stretched = error_of_table(true);
    EXPECT_LT(stretched.worst, .025);
    EXPECT_LT(stretched.worst_grazing, .08); // nearly a mirror, grazing
    EXPECT_LT(stretched.mean, .005);
}

TEST(Surface, NeverSendsOutMoreThanItGets) {
    for (const float metalness : {.2f, .5f, .8f}) {
        for (const double cosine : {.9, .3, .05}) {
            Scatterer at = surface(.6f, metalness, .3f);
            at.material.albedo = {1, .5f, 0};
            const test::Integral sum = test::integrate(at, from(cosine), 128);
            EXPECT_LT(sum.energy[0], 1.01);
            EXPECT_LT(sum.energy[1], .5 + .5 * sum.energy[0]);
            EXPECT_GT(sum.energy[2], .001); // black still reflects: 0.04 and the grazing edge
        }
    }
}

TEST(Surface, SamplesFollowTheDensity) {
    EXPECT_LT(test::chi_squared_z(surface(.5f, 0), from(.7)), test::kUnlikely);
    EXPECT_LT(test::chi_squared_z(surface(.7f, 1), from(.2)), test::kUnlikely);
    EXPECT_LT(test::chi_squared_z(surface(.4f, 1, .7f), from(.5, .2)), test::kUnlikely);
    EXPECT_LT(test::chi_squared_z(surface(1, .5f, 1), from(.05, .4)), test::kUnlikely);
}

TEST(Surface, WithoutSpecularItIsLambertian) {
    Scatterer at = surface(.5f, 0);
    at.material.specular = 0.0f;
    at.material.albedo = {.8f, .4f, .2f};
    for (const double cosine : {.9, .1}) {
        const Vec3f f = evaluate(at, from(cosine), from(.6, .7));
        EXPECT_NEAR(f.x, .8 * .6 / test::kPi, 1e-6);
        EXPECT_NEAR(f.z, .2 * .6 / test::kPi, 1e-6);
    }
}

TEST(Surface, GltfColoursReflectAtNormalIncidence) {
    // a smooth dielectric mirrors 4 % and a metal its colour
    Scatterer at = surface(.1f, 0);
    at.material.albedo = {};
    EXPECT_NEAR(test::mean_weight(at, from(1.0)).x, .04, .002);
    at.material.metalness = 1.0f;
    at.material.albedo = {.9f, .5f, .1f};
    const Vec3d gold = test::mean_weight(at, from(1.0));
    EXPECT_NEAR(gold.x, .9, .01);
    EXPECT_NEAR(gold.z, .1, .01);
}

TEST(Surface, AnAnisotropicHighlightStretchesAlongTheTangentAsGltfSays) {
    const Scatterer at = surface(.3f, 1, .6f);
    const Vec3f wi = at.axis;
    const float along = evaluate(at, wi, from(.9, 0.0)).x;
    const float across = evaluate(at, wi, from(.9, .25)).x;
    EXPECT_GT(along, 5.0f * across);
    const Scatterer round = surface(.3f, 1);
    EXPECT_NEAR(evaluate(round, wi, from(.9, 0.0)).x, evaluate(round, wi, from(.9, .25)).x, 1e-3f);
}

TEST(Surface, IsBlackFromBehindAndTowardsBehind) {
    const Scatterer at = surface(.5f, .5f, .5f);
    EXPECT_EQ(evaluate(at, from(-.3), from(.5)), Vec3f{});
    EXPECT_EQ(evaluate(at, from(.3), from(-.5)), Vec3f{});
    EXPECT_EQ(pdf(at, from(.3), from(-.5)), 0.0f);
    EXPECT_EQ(sample(at, from(-.3), {.5f, .5f, .5f}).weight, Vec3f{});
}

} // namespace
} // namespace heddle
