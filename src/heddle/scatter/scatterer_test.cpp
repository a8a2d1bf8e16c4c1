#include <heddle/scatter/scatterer.h>

#include <heddle/scatter/test_sphere.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace heddle {
namespace {

constexpr ScatterModel kModels[] = {ScatterModel::MicroflakeSpecular,
                                    ScatterModel::MicroflakeDiffuse,
                                    ScatterModel::LambertFiber,
                                    ScatterModel::LobeFiber,
                                    ScatterModel::Hair,
                                    ScatterModel::Surface};

/// Every model at both ends of its parameter ranges.
std::vector<Scatterer> extremes() {
    std::vector<Scatterer> all;
    for (const ScatterModel model : kModels) {
        for (int i = 0; i < 16; ++i) {
            const auto end = [i](int bit) { return (i >> bit & 1) != 0 ? 1.0f : 0.0f; };
            ScatterMaterial m;
            m.model = model;
            m.roughness = m.width_r = m.width_m = end(0);
            m.metalness = m.azimuth_tt = m.width_n = end(1);
            m.anisotropy = m.width_tt = end(2);
            m.absorption = Vec3f{1e6f, 1.0f, 0.0f} * end(3);
            m.albedo = m.color_r = Vec3f{1, 0, .5f} * end(3);
            m.eta = 1.0f + .5f * end(3);
            m.specular = end(0);
            Scatterer at = test::askew(m);
            at.lobe = end(1) > 0 ? SggxMatrix{.25f, .25f, .25f, 0, 0, 0}
                                 : SggxMatrix{1, 4e-6f, 4e-6f, 0, 0, 0};
            all.push_back(at);
        }
    }
    return all;
}

/// Directions for which something is undefined: along, across and very near to the axis.
std::vector<Vec3f> edges() {
    const test::Askew f;
    std::vector<Vec3f> all;
    for (const double z : {1.0, .9999999, .5, 1e-4, 1e-7, 0.0, -1e-7, -.5, -1.0}) {
        for (const double turns : {0.0, .25, .3, .5})
            all.push_back(f.world(test::direction(z, turns)));
    }
    return all;
}

bool is_right(float x) {
    return std::isfinite(x) && x >= 0.0f;
}

bool is_right(Vec3f v) {
    return is_right(v.x) && is_right(v.y) && is_right(v.z);
}

TEST(Scatterer, IsFiniteAndNotNegativeAtEveryEdge) {
    for (const Scatterer& at : extremes()) {
        for (const Vec3f& wi : edges()) {
            for (const Vec3f& wo : edges()) {
                const ScatterValue v = evaluate_with_pdf(at, wi, wo);
                ASSERT_TRUE(is_right(v.value) && is_right(v.pdf))
                    << static_cast<int>(at.material.model) << ' ' << v.value.x << ' ' << v.pdf;
            }
            ASSERT_TRUE(is_right(evaluate(at, wi, wi * -1.0f)));
        }
    }
}

TEST(Scatterer, SamplesAreUnitAndFiniteAtEveryEdge) {
    constexpr float kAlmostOne = 0x1.fffffep-1f;
    for (const Scatterer& at : extremes()) {
        for (const Vec3f& wi : edges()) {
            for (int i = 0; i < 8; ++i) {
                const auto end = [i](int bit) { return (i >> bit & 1) != 0 ? kAlmostOne : 0.0f; };
                const ScatterSample s = sample(at, wi, {end(0), end(1), end(2)});
                ASSERT_NEAR(length(s.direction), 1.0f, 1e-4f)
                    << static_cast<int>(at.material.model);
                ASSERT_TRUE(is_right(s.weight) && is_right(s.pdf));
                ASSERT_TRUE(s.roughness >= 0.0f && s.roughness <= 1.0f);
            }
        }
    }
}

TEST(Scatterer, ASamplesWeightIsItsValueOverItsDensity) {
    CounterRandom random{14, 1};
    for (const ScatterModel model : kModels) {
        ScatterMaterial m;
        m.model = model;
        m.anisotropy = .5f;
        Scatterer at = test::askew(m);
        at.lobe = {.3f, .25f, .2f, .02f, .01f, 0};
        int drawn = 0;
        for (int i = 0; i < 500; ++i) {
            const Vec3f wi = test::random_direction(random);
            const ScatterSample s = sample(at, wi, test::random_point(random));
            if (!(s.pdf > 0.0f)) continue;
            ++drawn;
            ASSERT_NEAR(pdf(at, wi, s.direction), s.pdf, 2e-3f * s.pdf);
            const Vec3f value = evaluate(at, wi, s.direction);
            ASSERT_NEAR(value.x / s.pdf, s.weight.x, 2e-3f * s.weight.x + 1e-6f);
            ASSERT_NEAR(value.z / s.pdf, s.weight.z, 2e-3f * s.weight.z + 1e-6f);
        }
        EXPECT_GT(drawn, 200) << static_cast<int>(model);
    }
}

TEST(Scatterer, WeightsStayNearTheEnergy) {
    CounterRandom random{14, 2};
    for (const ScatterModel model : kModels) {
        ScatterMaterial m;
        m.model = model;
        m.albedo = {1, 1, 1};
        Scatterer at = test::askew(m);
        at.lobe = {.3f, .25f, .2f, .02f, .01f, 0};
        const Vec3f wi = test::Askew{}.world({.6f, 0, .8f});
        for (int i = 0; i < 2000; ++i) {
            ASSERT_LT(sample(at, wi, test::random_point(random)).weight.x, 2.5f)
                << static_cast<int>(model);
        }
    }
}

} // namespace
} // namespace heddle
