#include <heddle/render/embree/test_trace.h>

#include <gtest/gtest.h>

#include <cmath>

namespace heddle {
namespace {

using namespace heddle::test;

constexpr Basis kBases[] = {Basis::Linear, Basis::CatmullRom, Basis::CubicBSpline};

// Rays at right angles to the x axis meet a cylinder about it as they meet a circle.
void expect_cylinder(Basis basis) {
    const auto scene = trace(straight_fiber(basis, {-1, 0, 0}, {1, 0, 0}, 0.1f));
    StreamRandom random{7};
    for (int i = 0; i < 200; ++i) {
        const double angle = 6.283 * static_cast<double>(random.uniform());
        const double beside = 0.095 * (2.0 * static_cast<double>(random.uniform()) - 1.0);
        const Vec3d out{0.0, std::cos(angle), std::sin(angle)};
        const Vec3d side{0.0, -out.z, out.y};
        const Vec3d on{0.3 * static_cast<double>(random.uniform()), 0.0, 0.0};
        const Ray ray = ray_to(on + 2.0 * out + beside * side, on + beside * side);
        TracedHit hit;
        ASSERT_TRUE(scene->intersect(ray, hit));
        const double deep = std::sqrt(0.01 - beside * beside);
        EXPECT_NEAR(static_cast<double>(hit.t), 2.0 - deep, 2e-4);
        const Vec3f normal = to_float((deep * out + beside * side) * 10.0);
        EXPECT_GT(dot(hit.normal, normal), 0.9995f);
        EXPECT_GT(dot(hit.normal, ray.direction * -1.0f), 0.0f);
    }
}

TEST(EmbreeScene, RaysMeetACylinderWhereItIs) {
    for (const Basis basis : kBases) {
        SCOPED_TRACE(static_cast<int>(basis));
        expect_cylinder(basis);
    }
}

// From the hit, what is reflected and what passes through meet the fiber no more.
void expect_free(const SurfaceScene& scene, const Ray& ray, const TracedHit& hit, Vec3d away) {
    const Vec3d at = ray.at(static_cast<double>(hit.t));
    const Vec3d step = to_double(hit.normal) * static_cast<double>(hit.offset);
    Ray through = ray;
    through.origin = at - step;
    EXPECT_FALSE(scene.occluded(through));
    Ray back = ray_to(at + step, at + step + away);
    EXPECT_FALSE(scene.occluded(back));
}

void expect_free(Basis basis, Vec3d middle, float radius, double distance) {
    const Vec3f half{1, 0, 0};
    const auto scene =
        trace(straight_fiber(basis, to_float(middle) - half, to_float(middle) + half, radius));
    StreamRandom random{3};
    int hits = 0;
    for (int i = 0; i < 1000; ++i) {
        const Vec3d d = draw_direction(random);
        if (std::abs(d.x) > 0.9) continue; // leaves the scene by the fiber's ends
        const Vec3d aim = middle + 0.5 * static_cast<double>(radius) * draw_direction(random);
        const Ray ray = ray_to(middle + distance * d, aim);
        TracedHit hit;
        if (!scene->intersect(ray, hit)) continue;
        ++hits;
        EXPECT_LT(hit.offset, 0.1f * radius);
        expect_free(*scene, ray, hit, d);
    }
    EXPECT_GT(hits, 800);
}

TEST(EmbreeScene, WhatStartsAtAHitMeetsTheFiberNoMore) {
    for (const Basis basis : kBases) {
        SCOPED_TRACE(static_cast<int>(basis));
        expect_free(basis, {}, 0.1f, 2.0);
        expect_free(basis, {40.0, 20.0, -10.0}, 0.00465f, 60.0); // a sweater's fiber
    }
}

TEST(EmbreeScene, ACurvesModelChoosesItsAxis) {
    ScatterMaterial m;
    const Ray ray = ray_to({0.05, 0.02, 2}, {0.05, 0.02, 0});
    TracedHit hit;
    for (const ScatterModel model : {ScatterModel::LobeFiber, ScatterModel::Hair}) {
        m.model = model;
        const auto scene = trace(straight_fiber(Basis::CatmullRom, {-1, 0, 0}, {1, 0, 0}, 0.1f), m);
        ASSERT_TRUE(scene->intersect(ray, hit));
        EXPECT_EQ(hit.scatterer.material.model, model);
        EXPECT_NEAR(std::abs(hit.scatterer.axis.x), 1.0f, 1e-4f);
        EXPECT_NEAR(dot(hit.scatterer.tangent, hit.scatterer.axis), 0.0f, 1e-5f);
    }
    m.model = ScatterModel::LambertFiber;
    m.specular = 1.0f;
    const auto scene = trace(straight_fiber(Basis::CatmullRom, {-1, 0, 0}, {1, 0, 0}, 0.1f), m);
    ASSERT_TRUE(scene->intersect(ray, hit));
    EXPECT_EQ(hit.scatterer.material.model, ScatterModel::Surface);
    EXPECT_EQ(hit.scatterer.material.specular, 0.0f);
    EXPECT_EQ(hit.scatterer.material.roughness, 1.0f);
    EXPECT_EQ(hit.scatterer.axis, hit.normal);
    EXPECT_NEAR(hit.normal.y, 0.2f, 1e-3f);
    EXPECT_NEAR(std::abs(hit.scatterer.tangent.x), 1.0f, 1e-4f);
}

CurveSet ring(Basis basis, int points) {
    CurveSet set;
    set.basis = basis;
    set.default_radius = 0.05f;
    std::vector<Vec3f> at;
    for (int i = 0; i < points; ++i) {
        const float a = 6.2831853f * static_cast<float>(i) / static_cast<float>(points);
        at.push_back({std::cos(a), std::sin(a), 0.0f});
    }
    add_curve(set, at, true);
    return set;
}

TEST(EmbreeScene, AClosedRingHasNoGap) {
    for (const Basis basis : kBases) {
        const auto scene = trace(geometry_of(ring(basis, 64)));
        for (int i = 0; i < 1000; ++i) {
            const double a = 6.283185307 * (i + 0.5) / 1000.0;
            const Vec3d on{std::cos(a), std::sin(a), 0.0};
            TracedHit hit;
            ASSERT_TRUE(scene->intersect(ray_to(on + Vec3d{0, 0, 3}, on), hit));
            EXPECT_NEAR(hit.t, 2.95f, 1e-3f);
            ASSERT_TRUE(scene->intersect(ray_to(on * 3.0, {}), hit));
            EXPECT_NEAR(hit.t, 1.95f, 3e-3f);
        }
        EXPECT_FALSE(scene->occluded(ray_to({0, 0, 3}, {0, 0, 0})));
    }
}

TEST(EmbreeScene, PointsColoursMultiplyTheAlbedoOfTheirSpan) {
    Geometry geometry = straight_fiber(Basis::CatmullRom, {0, 0, 0}, {5, 0, 0}, 0.1f);
    // spans run from x = 1 to 4: the first takes the colour of point 1
    geometry.curves[0].color = {0, 0xff, 0xff00, 0xff0000, 0, 0};
    ScatterMaterial m;
    m.albedo = {0.5f, 0.6f, 0.7f};
    const auto scene = trace(geometry, m);
    const Vec3f expected[] = {{0.5f, 0, 0}, {0, 0.6f, 0}, {0, 0, 0.7f}};
    for (int i = 0; i < 3; ++i) {
        TracedHit hit;
        ASSERT_TRUE(scene->intersect(ray_to({i + 1.5, 0, 2}, {i + 1.5, 0, 0}), hit));
        EXPECT_EQ(hit.scatterer.material.albedo, expected[i]);
    }
}

Geometry tangle(int fibers) {
    StreamRandom random{11};
    CurveSet set;
    set.basis = Basis::CatmullRom;
    set.default_radius = 0.02f;
    for (int i = 0; i < fibers; ++i) {
        std::vector<Vec3f> points;
        Vec3d at = draw_direction(random);
        for (int k = 0; k < 8; ++k) {
            points.push_back(to_float(at));
            at = at + 0.3 * draw_direction(random);
        }
        add_curve(set, points);
    }
    return geometry_of(set);
}

TEST(EmbreeScene, OccludedAgreesWithIntersect) {
    const auto scene = trace(tangle(60));
    StreamRandom random{5};
    int hits = 0;
    for (int i = 0; i < 5000; ++i) {
        Ray ray = ray_to(2.5 * draw_direction(random), 0.8 * draw_direction(random));
        if (i % 2 == 0) ray.t_max = 2.0f;
        TracedHit hit;
        const bool met = scene->intersect(ray, hit);
        EXPECT_EQ(met, scene->occluded(ray));
        EXPECT_TRUE(!met || hit.t <= ray.t_max);
        hits += met ? 1 : 0;
    }
    EXPECT_GT(hits, 500);
    EXPECT_LT(hits, 4500);
}

// A quarter turn about z, twice as long along x, moved.
const Affine kTurned{{0, 2, 0}, {-1, 0, 0}, {0, 0, 1}, {5, -3, 2}};

TEST(EmbreeScene, ARotatedInstanceIsRotatedInput) {
    Affine turn = kTurned;
    turn.x = {0, 1, 0};
    const Geometry geometry = tangle(60);
    Geometry turned = geometry;
    for (Vec3f& p : turned.curves[0].points) p = to_float(turn.point(to_double(p)));
    const auto instanced = trace(geometry, {}, {Affine{}, turn});
    const auto input = trace(turned);
    StreamRandom random{9};
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const Ray ray = ray_to(turn.offset + 2.5 * draw_direction(random),
                               turn.offset + 0.8 * draw_direction(random));
        TracedHit a, b;
        const bool met = instanced->intersect(ray, a);
        if (met && a.object == 0) continue; // the one at the origin is in the way
        EXPECT_EQ(met, input->intersect(ray, b));
        if (!met || std::abs(a.t - b.t) > 1e-3f) continue; // grazing rays may pass one of them
        ++hits;
        EXPECT_EQ(a.object, 1u);
        EXPECT_GT(dot(a.normal, b.normal), 0.99f);
        EXPECT_GT(std::abs(dot(a.scatterer.tangent, b.scatterer.tangent)), 0.99f);
    }
    EXPECT_GT(hits, 300);
}

TEST(EmbreeScene, ObjectsMayShareAGeometryAndDifferInMaterial) {
    const auto fiber = std::make_shared<const Geometry>(
        straight_fiber(Basis::CatmullRom, {-1, 0, 0}, {1, 0, 0}, 0.1f));
    const Affine beside{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 0}};
    const TracedObject objects[] = {{fiber, {Affine{}}, {1}}, {fiber, {beside}, {0}}};
    std::vector<ScatterMaterial> materials(2);
    materials[1].albedo = {0.1f, 0.2f, 0.3f};
    Progress silent;
    const auto scene = build_embree_scene(objects, materials, silent);
    TracedHit hit;
    ASSERT_TRUE(scene->intersect(ray_to({0, 0, 1}, {}), hit));
    EXPECT_EQ(hit.object, 0u);
    EXPECT_EQ(hit.material, 1u);
    EXPECT_EQ(hit.scatterer.material.albedo, materials[1].albedo);
    ASSERT_TRUE(scene->intersect(ray_to({0, 1, 1}, {0, 1, 0}), hit));
    EXPECT_EQ(hit.object, 1u);
    EXPECT_EQ(hit.material, 0u);
}

TEST(EmbreeScene, NormalsOfAStretchedInstanceStayAtRightAnglesToIt) {
    const auto scene =
        trace(straight_fiber(Basis::CatmullRom, {0, 0, -3}, {0, 0, 3}, 0.5f), {}, {kTurned});
    // the circle of radius 0.5 becomes an ellipse of half axes 0.5 along x and 1 along y
    TracedHit hit;
    const Vec3d on = kTurned.offset + Vec3d{0.3, 0.8, 0.0};
    ASSERT_TRUE(scene->intersect(ray_to(on + Vec3d{3, 0, 0}, on), hit));
    EXPECT_NEAR(hit.t, 3.0f, 1e-3f);
    const Vec3f normal = normalize(Vec3f{0.3f / 0.25f, 0.8f, 0.0f});
    EXPECT_GT(dot(hit.normal, normal), 0.9999f);
}

TEST(EmbreeScene, FibersAreRoundFromFarAway) {
    const auto scene = trace(straight_fiber(Basis::CatmullRom, {-1, 0, 0}, {1, 0, 0}, 1e-3f));
    int hits = 0;
    for (int i = 0; i < 1000; ++i) {
        const double y = 4e-3 * ((i + 0.5) / 1000.0 - 0.5);
        hits += scene->occluded(ray_to({0.01, y, 5e4}, {0.01, y, 0})) ? 1 : 0;
    }
    EXPECT_NEAR(hits, 500, 10);
}

TEST(EmbreeScene, NothingIsMetWhereThereIsNothing) {
    Progress silent;
    const auto none = build_embree_scene({}, {}, silent);
    TracedHit hit;
    EXPECT_FALSE(none->intersect(ray_to({0, 0, 1}, {}), hit));
    EXPECT_FALSE(none->occluded(ray_to({0, 0, 1}, {})));
    EXPECT_FALSE(trace(Geometry{})->intersect(ray_to({0, 0, 1}, {}), hit));
}

TEST(EmbreeScene, CurvesWithoutLengthAreNotThere) {
    for (const Basis basis : kBases) {
        CurveSet set;
        set.basis = basis;
        set.default_radius = 0.1f;
        add_curve(set, std::vector<Vec3f>(6, Vec3f{}));
        add_curve(set, {{1, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 0, 0}});
        const auto scene = trace(geometry_of(set));
        EXPECT_FALSE(scene->occluded(ray_to({0, 0, 2}, {})));
        EXPECT_TRUE(scene->occluded(ray_to({2, 0, 2}, {2, 0, 0})));
    }
}

TEST(EmbreeScene, BadObjectsAreRefused) {
    const auto refused = [](const TracedObject& object, ErrorCode code) {
        Progress silent;
        try {
            const auto scene = build_embree_scene({&object, 1}, {{}}, silent);
            ADD_FAILURE() << "no error";
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), code) << e.what();
        }
    };
    const auto geometry = std::make_shared<const Geometry>(tangle(1));
    refused({nullptr, {Affine{}}, {0}}, ErrorCode::InvalidArgument);
    refused({geometry, {}, {0}}, ErrorCode::InvalidArgument);
    refused({geometry, {Affine{}}, {}}, ErrorCode::InvalidArgument);
    refused({geometry, {Affine{}}, {1}}, ErrorCode::InvalidArgument);
    refused({geometry, {Affine{{}, {}, {}, {}}}, {0}}, ErrorCode::InvalidArgument);
    refused({geometry, {Affine{{NAN, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}}}, {0}},
            ErrorCode::InvalidArgument);
}

TEST(EmbreeScene, ItKeepsToItsMemory) {
    try {
        const auto scene = trace(tangle(2000), {}, {Affine{}}, {.memory_bytes = 1 << 18});
        ADD_FAILURE() << "no error";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::OutOfMemory) << e.what();
    }
}

TEST(EmbreeScene, ACancelledBuildStops) {
    Progress progress;
    progress.cancel();
    const TracedObject object{std::make_shared<const Geometry>(tangle(10)), {Affine{}}, {0}};
    EXPECT_THROW(static_cast<void>(build_embree_scene({&object, 1}, {{}}, progress)), Error);
}

} // namespace
} // namespace heddle
