#include <heddle/render/light.h>
#include <heddle/render/volume/test_volume.h>

#include <gtest/gtest.h>

#include <numbers>

namespace heddle {
namespace {

using namespace heddle::testing;

constexpr double kPi = std::numbers::pi;

Light environment() {
    auto map = std::make_shared<EnvironmentMap>();
    map->width = 16;
    map->height = 8;
    StreamRandom random{2};
    for (int i = 0; i < 16 * 8; ++i) {
        const float y = random.uniform();
        map->radiance.push_back(Vec3f{y, y * random.uniform(), y * y} * (i % 5 == 0 ? 0.0f : 3.0f));
    }
    map->up = normalize(Vec3f{0.2f, 0.3f, 1.0f});
    map->front = normalize(any_perpendicular(map->up));
    Light light;
    light.kind = LightKind::Environment;
    light.color = {1.0f, 0.5f, 2.0f};
    light.map = map;
    return light;
}

Light constant(Vec3f color) {
    Light light;
    light.color = color;
    return light;
}

Light area(Vec3d corner, Vec3d u, Vec3d v, Vec3f color = {2, 2, 2}) {
    Light light;
    light.kind = LightKind::Area;
    light.color = color;
    light.position = corner;
    light.edge_u = u;
    light.edge_v = v;
    return light;
}

Vec3f three(StreamRandom& random) {
    const float a = random.uniform(), b = random.uniform();
    return {a, b, random.uniform()};
}

/// Calls f(direction, steradians) for the cells of a grid over the sphere.
template <typename F>
void over_sphere(int rows, const F& f) {
    for (int i = 0; i < rows; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / rows;
        for (int j = 0; j < 2 * rows; ++j) {
            const double phi = kPi * (j + 0.5) / rows, r = std::sqrt(1.0 - z * z);
            f(to_float(Vec3d{r * std::cos(phi), r * std::sin(phi), z}), 2.0 * kPi / rows / rows);
        }
    }
}

TEST(LightSet, DensityOfTheBackgroundIntegratesToOne) {
    for (const auto& lights : {std::vector<Light>{environment()},
                               std::vector<Light>{environment(), constant({0.1f, 1.0f, 0.3f})},
                               std::vector<Light>{constant({1, 1, 1})}}) {
        const LightSet set(lights, 3.0);
        double sum = 0.0;
        over_sphere(400, [&](Vec3f d, double area_of_cell) {
            sum += area_of_cell * static_cast<double>(set.background(d).pdf);
        });
        EXPECT_NEAR(sum, 1.0, 5e-3);
    }
}

TEST(LightSet, SamplesOfTheBackgroundHaveItsDensityAndRadiance) {
    const LightSet set({environment(), constant({0.1f, 1.0f, 0.3f})}, 3.0);
    StreamRandom random{4};
    for (int i = 0; i < 2000; ++i) {
        const LightSample s = set.sample({}, three(random));
        if (s.pdf == 0.0f) continue;
        const LightHit hit = set.background(s.direction);
        EXPECT_FLOAT_EQ(s.pdf, hit.pdf);
        EXPECT_NEAR(s.radiance.y * s.pdf, hit.radiance.y, 1e-4f * hit.radiance.y);
        EXPECT_TRUE(std::isinf(s.distance));
        EXPECT_NEAR(length(s.direction), 1.0f, 1e-5f);
    }
}

TEST(LightSet, SamplesOfAnEnvironmentFallAsItsDensity) {
    const LightSet set({environment()}, 3.0);
    constexpr int kRows = 12, kCount = 60000;
    const auto bin = [](Vec3f d) {
        const int row = std::min(kRows - 1, static_cast<int>((1.0f - d.z) * 0.5f * kRows));
        const double turn = std::atan2(static_cast<double>(d.y), static_cast<double>(d.x)) / kPi;
        const int column = static_cast<int>((turn < 0.0 ? turn + 2.0 : turn) * kRows);
        return static_cast<std::size_t>(row * 2 * kRows + std::min(column, 2 * kRows - 1));
    };
    std::vector<double> expected(2 * kRows * kRows), observed(expected);
    over_sphere(kRows * 60, [&](Vec3f d, double steradians) {
        expected[bin(d)] += kCount * steradians * static_cast<double>(set.background(d).pdf);
    });
    StreamRandom random{5};
    for (int i = 0; i < kCount; ++i) {
        observed[bin(set.sample({}, three(random)).direction)] += 1.0;
    }
    std::vector<double> o, e;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        if (expected[i] < 8.0) continue;
        o.push_back(observed[i]);
        e.push_back(expected[i]);
    }
    EXPECT_GT(e.size(), 100u);
    EXPECT_LT(chi_squared_z(o, e), 4.0);
}

TEST(LightSet, SamplesAddUpToTheLightThatArrives) { // over the sphere, of a whole scene
    std::vector<Light> lights{environment(), constant({0.1f, 1.0f, 0.3f}),
                              area({-1, -1, 4}, {0, 2, 0}, {2, 0, 0})};
    Light sun;
    sun.kind = LightKind::Directional;
    sun.color = {3, 2, 1};
    lights.push_back(sun);
    Light lamp;
    lamp.kind = LightKind::Point;
    lamp.position = {0, 3, 0};
    lamp.color = {9, 9, 9};
    lights.push_back(lamp);
    const LightSet set(lights, 3.0);
    double truth = 2.0 + 9.0 / 9.0;
    Ray ray;
    over_sphere(400, [&](Vec3f d, double steradians) {
        ray.direction = d;
        LightHit hit;
        truth += steradians * static_cast<double>(set.background(d).radiance.y);
        if (set.intersect(ray, hit)) truth += steradians * static_cast<double>(hit.radiance.y);
    });
    MeanOf mean;
    StreamRandom random{6};
    for (int i = 0; i < 40000; ++i) {
        mean.add(static_cast<double>(set.sample({}, three(random)).radiance.y));
    }
    EXPECT_NEAR(mean.mean(), truth, 4.0 * mean.error() + 0.005 * truth);
    EXPECT_LT(mean.error(), 0.02 * truth);
}

TEST(LightSet, AnAreaLightIsMetWhereItsSamplesAre) {
    const LightSet set({area({1, -1, 3}, {0.5, 2, 0.3}, {-2, 0.3, 0}), constant({1, 1, 1})}, 2.0);
    StreamRandom random{7};
    int drawn = 0, met = 0;
    for (int i = 0; i < 2000; ++i) {
        const LightSample s = set.sample({0.1, 0.2, 8.0}, three(random));
        if (std::isinf(s.distance)) continue;
        ++drawn;
        Ray ray;
        ray.origin = {0.1, 0.2, 8.0};
        ray.direction = s.direction;
        LightHit hit;
        if (!set.intersect(ray, hit)) continue; // on its rim, by rounding
        EXPECT_NEAR(hit.t, s.distance, 1e-4f * s.distance);
        EXPECT_NEAR(hit.pdf, s.pdf, 2e-4f * s.pdf);
        EXPECT_NEAR(s.radiance.x * s.pdf, hit.radiance.x, 1e-3f);
        ray.t_max = s.distance * 0.99f;
        EXPECT_FALSE(set.intersect(ray, hit));
        ++met;
    }
    EXPECT_GT(drawn, 300);
    EXPECT_GE(met, drawn - 2);
}

TEST(LightSet, AnAreaLightIsDarkFromBehind) {
    const LightSet set({area({-1, -1, 3}, {2, 0, 0}, {0, 2, 0})}, 1.0); // shines towards +z
    Ray ray;
    ray.direction = {0, 0, 1};
    LightHit hit;
    EXPECT_FALSE(set.intersect(ray, hit));
    EXPECT_EQ(set.sample({}, {0.5f, 0.5f, 0.5f}).radiance.x, 0.0f);
    EXPECT_GT(set.sample({0, 0, 5}, {0.5f, 0.5f, 0.5f}).radiance.x, 0.0f);
}

TEST(LightSet, AnEnvironmentStandsAsItsAxesSay) {
    auto map = std::make_shared<EnvironmentMap>();
    map->width = 8;
    map->height = 4;
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 8; ++x) {
            map->radiance.push_back({static_cast<float>(x), static_cast<float>(y), 1.0f});
        }
    }
    Light light;
    light.kind = LightKind::Environment;
    light.map = map;
    const LightSet set({light}, 1.0);
    EXPECT_EQ(set.background({0, 1, 0}).radiance.y, 0.0f); // up: the first row
    EXPECT_EQ(set.background({0, -1, 0}).radiance.y, 3.0f);
    EXPECT_EQ(set.background(normalize(Vec3f{-0.1f, 0.1f, 1})).radiance.x, 4.0f); // right of front
    EXPECT_EQ(set.background(normalize(Vec3f{0.1f, 0.1f, 1})).radiance.x, 3.0f);
    EXPECT_EQ(set.background(normalize(Vec3f{-1, 0.1f, 0.1f})).radiance.x,
              5.0f); // as seen from inside
}

TEST(LightSet, WithoutLightNothingArrives) {
    const LightSet none({}, 1.0);
    EXPECT_EQ(none.sample({}, {0.5f, 0.5f, 0.5f}).radiance.x, 0.0f);
    EXPECT_EQ(none.background({0, 0, 1}).radiance.x, 0.0f);
    const LightSet dark({constant({0, 0, 0})}, 0.0);
    EXPECT_EQ(dark.sample({}, {0.5f, 0.5f, 0.5f}).radiance.x, 0.0f);
}

} // namespace
} // namespace heddle
