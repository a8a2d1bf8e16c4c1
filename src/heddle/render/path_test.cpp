#include <heddle/render/path.h>
#include <heddle/render/volume/test_sheet.h>

#include <gtest/gtest.h>

#include <array>

namespace heddle {
namespace {

using namespace heddle::testing;

Light constant(Vec3f color = {1, 1, 1}) {
    Light light;
    light.color = color;
    return light;
}

Light area(Vec3d corner, Vec3d u, Vec3d v, Vec3f color) {
    Light light;
    light.kind = LightKind::Area;
    light.color = color;
    light.position = corner;
    light.edge_u = u;
    light.edge_v = v;
    return light;
}

VoxelMap cloud(std::uint64_t seed = 3) {
    VoxelMap voxels;
    StreamRandom random{seed};
    add_random(voxels, random, {-3, -3, -3}, 6, 300, 0.8);
    return voxels;
}

PathScene scene_of(const ScatterMaterial& material, MaterialKind kind) {
    PathScene scene;
    scene.volumes.push_back(volume_of(cloud(), {}, {1, 1, 1}, kind));
    scene.materials = {material};
    scene.lights = LightSet({constant()}, 5.0);
    return scene;
}

/// Mean radiance of rays at the origin from all around, and what of it was met by none.
struct Seen {
    MeanOf radiance, transmittance;
};

Seen look(const PathScene& scene, const PathOptions& options, int paths, double from = 10.0) {
    Seen out;
    StreamRandom random{17};
    for (int i = 0; i < paths; ++i) {
        const Vec3f d = random_direction(random);
        const Vec3d aside = to_double(random_direction(random)) * 2.0;
        const Ray ray = ray_along(to_double(d) * -from + aside, to_double(d));
        PathSampler sampler(1, static_cast<std::uint64_t>(i), 0);
        const PathSample sample = trace_path(scene, options, ray, sampler);
        out.radiance.add(static_cast<double>(sample.radiance.y));
        out.transmittance.add(static_cast<double>(sample.transmittance));
    }
    return out;
}

PathOptions patient() {
    PathOptions options;
    options.max_depth = options.roulette_depth = 3000;
    return options;
}

ScatterMaterial white(ScatterModel model) {
    ScatterMaterial m;
    m.model = model;
    m.albedo = {1, 1, 1};
    m.color_r = {0.3f, 0.3f, 0.3f};
    m.color_tt = {0.7f, 0.7f, 0.7f};
    m.absorption = {};
    m.specular = 0.0f;
    return m;
}

void expect_furnace(const PathScene& scene, double tolerance, int paths = 3000) {
    const Seen seen = look(scene, patient(), paths);
    EXPECT_LT(seen.transmittance.mean(), 0.6); // there is something in it
    EXPECT_LT(seen.radiance.error(), 0.02);
    EXPECT_NEAR(seen.radiance.mean(), 1.0, 4.0 * seen.radiance.error() + tolerance);
}

TEST(TracePath, WhiteThingsVanishInAWhiteWorld) {
    for (const ScatterModel model :
         {ScatterModel::MicroflakeSpecular, ScatterModel::MicroflakeDiffuse,
          ScatterModel::LambertFiber, ScatterModel::LobeFiber, ScatterModel::Hair}) {
        SCOPED_TRACE(static_cast<int>(model));
        expect_furnace(scene_of(white(model), MaterialKind::Fiber), 2e-3);
    }
    for (const ScatterModel model : {ScatterModel::MicroflakeSpecular,
                                     ScatterModel::MicroflakeDiffuse, ScatterModel::Surface}) {
        SCOPED_TRACE(static_cast<int>(model));
        expect_furnace(scene_of(white(model), MaterialKind::Surface), 2e-3);
    }
}

TEST(TracePath, FibersWithCellsVanishTooInAWhiteWorld) {
    for (const ScatterModel model : {ScatterModel::LambertFiber, ScatterModel::LobeFiber}) {
        PathScene scene = scene_of(white(model), MaterialKind::Fiber);
        StreamRandom random{5};
        const auto level = level_with_cells(
            cloud(), 0.02f, [&](std::size_t) { return random.next() | 1; }, 0, 0.3);
        EXPECT_GT(level->crowding(), 1.5f); // bundles shade themselves
        scene.volumes = {{{level}, {}, {0}}};
        expect_furnace(scene, 2e-3, 12000);
    }
}

TEST(TracePath, RouletteKeepsTheMean) {
    PathOptions options;
    options.max_depth = 3000;
    const Seen seen =
        look(scene_of(white(ScatterModel::LambertFiber), MaterialKind::Fiber), options, 8000);
    EXPECT_NEAR(seen.radiance.mean(), 1.0, 4.0 * seen.radiance.error());
    EXPECT_LT(seen.radiance.error(), 0.02);
}

TEST(TracePath, TurnedAndStretchedVolumesVanishTooInAWhiteWorld) {
    PathScene scene = scene_of(white(ScatterModel::LambertFiber), MaterialKind::Fiber);
    const Affine placed{{0.6, 0.8, 0}, {-0.8, 0.6, 0.3}, {0, 0.1, 1.5}, {0.5, 0, 0}};
    scene.volumes = {volume_of(cloud(), placed)};
    expect_furnace(scene, 2e-3);
    scene.materials = {white(ScatterModel::MicroflakeSpecular)};
    expect_furnace(scene, 2e-3);
}

/// A ball of radius 1 about the origin, seen from outside.
class Ball final : public SurfaceScene {
public:
    explicit Ball(const ScatterMaterial& material) : material_(material) {}
    [[nodiscard]] bool intersect(const Ray& ray, TracedHit& hit) const override {
        const Vec3d d = to_double(ray.direction);
        const double b = dot(ray.origin, d);
        const double q = b * b - dot(ray.origin, ray.origin) + 1.0;
        if (q < 0.0 || -b - std::sqrt(q) < 0.0) return false;
        hit.t = static_cast<float>(-b - std::sqrt(q));
        if (hit.t >= ray.t_max) return false;
        hit.normal = normalize(to_float(ray.at(static_cast<double>(hit.t))));
        hit.offset = 1e-4f;
        hit.scatterer.material = material_;
        hit.scatterer.axis = hit.normal;
        hit.scatterer.tangent = any_perpendicular(hit.normal);
        return true;
    }
    [[nodiscard]] bool occluded(const Ray& ray) const override {
        TracedHit hit;
        return intersect(ray, hit);
    }
    [[nodiscard]] Bounds bounds() const override {
        Bounds box;
        box.grow(Vec3d{}, 1.0);
        return box;
    }
    [[nodiscard]] std::int64_t byte_count() const override { return 0; }

private:
    ScatterMaterial material_;
};

/// Where the middle of a sphere of voxels is.
constexpr Vec3d kMiddle{0.31, 0.77, 0.13};

PathScene sphere_scene(double radius, const ScatterMaterial& material) {
    const auto level = sheet_level(sphere_at(kMiddle, radius), static_cast<int>(radius) + 2);
    PathScene scene;
    scene.volumes.push_back(VolumeInstance({level}, {}, {0}));
    scene.materials = {material};
    return scene;
}

/// Returns the radiance of a sphere seen along z, as a volume and traced, under one sun.
std::array<MeanOf, 2> sphere_under_sun(double radius, double degrees) {
    ScatterMaterial matte = white(ScatterModel::Surface);
    matte.albedo = {0.8f, 0.8f, 0.8f};
    PathScene volume = sphere_scene(radius, matte);
    PathScene traced;
    traced.surfaces = std::make_shared<Ball>(matte);
    const double angle = degrees * 3.14159265 / 180.0;
    Light sun;
    sun.kind = LightKind::Directional;
    sun.direction = to_float(Vec3d{-std::sin(angle), 0, -std::cos(angle)});
    volume.lights = traced.lights = LightSet({sun}, 5.0);
    PathOptions options;
    options.level = 0;
    std::array<MeanOf, 2> out;
    StreamRandom random{5};
    for (std::uint64_t i = 0; i < 12000; ++i) {
        const auto aside = [&] { return 2.4 * static_cast<double>(random.uniform()) - 1.2; };
        const Vec3d from{aside(), aside(), 3.0};
        PathSampler a(1, i, 0);
        PathSampler b(1, i, 0);
        const Ray ray = ray_along(kMiddle + from * radius, {0, 0, -1});
        out[0].add(static_cast<double>(trace_path(volume, options, ray, a).radiance.y));
        const Ray same = ray_along(from, {0, 0, -1});
        out[1].add(static_cast<double>(trace_path(traced, options, same, b).radiance.y));
    }
    return out;
}

TEST(TracePath, ASphereOfSheetsIsAsBrightAsTheSphere) {
    for (const double degrees : {0.0, 40.0, 80.0, 130.0}) {
        const auto [volume, traced] = sphere_under_sun(6.0, degrees);
        EXPECT_NEAR(volume.mean() / traced.mean(), 1.0, 0.03) << degrees; // the rays are the same
    }
}

TEST(TracePath, WhiteSheetsVanishInAWhiteWorld) {
    PathScene scene = sphere_scene(3.0, white(ScatterModel::Surface));
    scene.lights = LightSet({constant()}, 5.0);
    expect_furnace(scene, 2e-3);
}

TEST(TracePath, WhiteSurfacesVanishInAWhiteWorldAmongVolumes) {
    PathScene scene = scene_of(white(ScatterModel::LambertFiber), MaterialKind::Fiber);
    scene.surfaces = std::make_shared<Ball>(white(ScatterModel::Surface));
    expect_furnace(scene, 2e-3);
    scene.volumes.clear();
    const Seen seen = look(scene, patient(), 2000);
    EXPECT_NEAR(seen.radiance.mean(), 1.0, 4.0 * seen.radiance.error() + 1e-3);
}

TEST(TracePath, SurfacesAndVolumesHideEachOther) {
    PathScene scene = scene_of(white(ScatterModel::LambertFiber), MaterialKind::Fiber);
    PathOptions dark;
    dark.max_depth = 0;
    const Ray ray = ray_along({0.2, 0.3, 10}, {0, 0, -1});
    const auto radiance = [&](std::uint32_t s) {
        PathSampler sampler(1, 1, s);
        return trace_path(scene, dark, ray, sampler);
    };
    MeanOf volume;
    for (std::uint32_t s = 0; s < 4000; ++s)
        volume.add(static_cast<double>(radiance(s).radiance.y));
    EXPECT_NEAR(volume.mean(), static_cast<double>(radiance(0).transmittance),
                4.0 * volume.error());
    scene.surfaces = std::make_shared<Ball>(white(ScatterModel::Surface));
    EXPECT_EQ(radiance(0).radiance.y, 0.0f);
    EXPECT_EQ(radiance(0).transmittance, 0.0f);
    MeanOf front; // volume in front of the ball is met first
    for (std::uint32_t s = 0; s < 500; ++s) front.add(radiance(s).first.depth < 8.9f ? 1.0 : 0.0);
    EXPECT_GT(front.mean(), 0.1);
}

TEST(TracePath, OverlappingVolumesPassTheProductAndStayWhite) {
    PathScene scene = scene_of(white(ScatterModel::LambertFiber), MaterialKind::Fiber);
    const Ray ray = ray_along({0.2, 0.3, 10}, {0.1, 0, -1});
    const auto passes = [&] {
        PathSampler sampler(1, 1, 0);
        return trace_path(scene, {}, ray, sampler).transmittance;
    };
    const float first = passes();
    const VolumeInstance other =
        volume_of(cloud(8), {{1, 0.2, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0, 0}});
    scene.volumes.push_back(other);
    const float both = passes();
    scene.volumes.erase(scene.volumes.begin());
    EXPECT_NEAR(both, first * passes(), 1e-5f);
    scene.volumes.push_back(volume_of(cloud()));
    expect_furnace(scene, 2e-3);
}

TEST(TracePath, OneVoxelUnderASunIsTheQuadratureOfItsDepth) {
    PathScene scene;
    VoxelMap voxels;
    voxels[{0, 0, 0}] = even_voxel(0.8, {{needle({0, 0.6f, 0.8f}, 0.4f), 255, 0}});
    scene.volumes.push_back(volume_of(voxels));
    scene.materials = {white(ScatterModel::LambertFiber)};
    Light sun;
    sun.kind = LightKind::Directional;
    sun.color = {3, 3, 3};
    sun.direction = normalize(Vec3f{-1.0f, 0.0f, -0.5f});
    scene.lights = LightSet({sun}, 1.0);
    PathOptions once;
    once.max_depth = 1;
    const Ray ray = ray_along({0.4, 0.5, 5.0}, {0, 0, -1});
    MeanOf traced;
    for (std::uint32_t s = 0; s < 20000; ++s) {
        PathSampler sampler(2, 1, s);
        traced.add(static_cast<double>(trace_path(scene, once, ray, sampler).radiance.y));
    }
    const VolumeInstance& volume = scene.volumes[0];
    StreamRandom random{3};
    const auto passes = [&](Vec3d from, Vec3d towards, double t_max) {
        Ray r = ray_along(from, towards);
        r.t_max = static_cast<float>(t_max);
        return static_cast<double>(volume.transmittance(r, Transport::Product, {}, random));
    };
    VolumeHit hit;
    hit.leaf = volume.pyramid()[0]->find_leaf({0, 0, 0}).leaf;
    MeanOf phase;
    for (int i = 0; i < 20000; ++i) {
        const Scatterer at = volume.scatter(hit, {0, 0, 1}, scene.materials, random).scatterer;
        phase.add(static_cast<double>(evaluate(at, {0, 0, 1}, sun.direction * -1.0f).y));
    }
    double expected = 0.0;
    constexpr int kSteps = 200;
    for (int i = 0; i < kSteps; ++i) {
        const double z = 1.0 - (i + 0.5) / kSteps;
        const double stopped =
            passes(ray.origin, {0, 0, -1}, 4.0 + static_cast<double>(i) / kSteps) -
            passes(ray.origin, {0, 0, -1}, 4.0 + (i + 1.0) / kSteps);
        expected += stopped * passes({0.4, 0.5, z}, {1.0, 0.0, 0.5}, 100.0);
    }
    expected *= 3.0 * phase.mean();
    EXPECT_NEAR(traced.mean(), expected,
                4.0 * traced.error() + 4.0 * expected * phase.error() / phase.mean());
    EXPECT_LT(traced.error(), 0.02 * expected);
}

/// One scattering, its direction drawn from the scatterer alone: lights are met by chance.
double by_chance(const PathScene& scene, const Ray& ray, StreamRandom& random) {
    VolumeHit hit;
    if (!scene.volumes[0].sample_flight(ray, Transport::Automatic, {}, random, hit)) return 0.0;
    const Scatterer at =
        scene.volumes[0].scatter(hit, ray.direction * -1.0f, scene.materials, random).scatterer;
    const float a = random.uniform(), b = random.uniform();
    const ScatterSample s = sample(at, ray.direction * -1.0f, {a, b, random.uniform()});
    if (!(s.pdf > 0.0f)) return 0.0;
    Ray on = ray_along(ray.at(static_cast<double>(hit.t)), to_double(s.direction));
    LightHit light;
    float radiance = 0.0f;
    if (scene.lights.intersect(on, light)) {
        on.t_max = light.t;
        radiance = light.radiance.y;
    } else {
        radiance = scene.lights.background(s.direction).radiance.y;
    }
    return static_cast<double>(
        s.weight.y * radiance *
        scene.volumes[0].transmittance(on, Transport::Automatic, {}, random));
}

// A lamp close by, another behind it that it hides in part, and a sky behind both.
TEST(TracePath, LightsDrawnAndMetByChanceGiveOneValue) {
    for (const ScatterModel model :
         {ScatterModel::LambertFiber, ScatterModel::MicroflakeSpecular}) {
        PathScene scene = scene_of(white(model), MaterialKind::Fiber);
        scene.lights = LightSet({area({-3, -3, 5}, {0, 6, 0}, {6, 0, 0}, {0.3f, 0.3f, 0.3f}),
                                 area({-6, -6, 8}, {0, 12, 0}, {12, 0, 0}, {2, 2, 2}),
                                 constant({0.5f, 0.5f, 0.5f})},
                                5.0);
        PathOptions once;
        once.max_depth = 1;
        const Ray ray = ray_along({0.3, -8, 0.4}, {0, 1, 0.05});
        MeanOf traced, chance;
        StreamRandom random{31};
        for (std::uint32_t s = 0; s < 40000; ++s) {
            PathSampler sampler(2, 1, s);
            PathSample sample = trace_path(scene, once, ray, sampler);
            if (!sample.first.any) sample.radiance = {}; // the sky, straight through
            traced.add(static_cast<double>(sample.radiance.y));
            chance.add(by_chance(scene, ray, random));
        }
        EXPECT_NEAR(traced.mean(), chance.mean(), 4.0 * std::hypot(traced.error(), chance.error()));
        EXPECT_LT(chance.error(), 0.01 * chance.mean());
    }
}

TEST(TracePath, ALampIsSeenByTheCamera) {
    PathScene scene;
    scene.lights = LightSet({area({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, {5, 6, 7})}, 1.0);
    PathSampler sampler(1, 1, 1);
    EXPECT_EQ(trace_path(scene, {}, ray_along({0, 0, 3}, {0, 0, -1}), sampler).radiance,
              (Vec3f{5, 6, 7}));
    EXPECT_EQ(trace_path(scene, {}, ray_along({0, 0, -3}, {0, 0, 1}), sampler).radiance, (Vec3f{}));
}

TEST(TracePath, StartsInsideAVolume) {
    const PathScene scene = scene_of(white(ScatterModel::LambertFiber), MaterialKind::Fiber);
    const Seen seen = look(scene, patient(), 2000, 0.0);
    EXPECT_NEAR(seen.radiance.mean(), 1.0, 4.0 * seen.radiance.error() + 2e-3);
    EXPECT_LT(seen.transmittance.mean(), 0.7);
}

TEST(TracePath, IsTheSameEachTime) {
    const PathScene scene = scene_of(white(ScatterModel::Hair), MaterialKind::Fiber);
    const auto trace = [&] {
        PathSampler sampler(1, 2, 3);
        return trace_path(scene, {}, ray_along({0, 0, 9}, {0.1, 0, -1}), sampler).radiance;
    };
    EXPECT_EQ(trace(), trace());
}

} // namespace
} // namespace heddle
