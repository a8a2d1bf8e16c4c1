#include <heddle/render/volume/test_volume.h>
#include <heddle/sggx/moments.h>

#include <gtest/gtest.h>

#include <numbers>

namespace heddle {
namespace {

using namespace heddle::testing;

const LevelChoice kFinest{0, 0.0f, 0.5f};
constexpr double kUnlikely = 4.0; // one in 30,000 for a right sampler

double passes(const VolumeInstance& volume, const Ray& ray, const LevelChoice& choice = kFinest) {
    StreamRandom random{1};
    return static_cast<double>(volume.transmittance(ray, Transport::Product, choice, random));
}

std::vector<Lobe> one_lobe(Vec3f axis = {1, 0, 0}) {
    return {{needle(axis), 255, 0}};
}

VoxelMap cloud(double most = 0.6) {
    VoxelMap voxels;
    StreamRandom random{3};
    add_random(voxels, random, {-6, -6, -6}, 12, 600, most);
    return voxels;
}

/// Along an axis, from both ends of a row whose product of 1 - coverage is known.
void expect_row(const Affine& to_world, Vec3d voxel_size) {
    for (int axis = 0; axis < 3; ++axis) {
        VoxelMap voxels;
        double product = 1.0;
        for (const int i : {-5, -4, 0, 1, 2, 9, 200}) {
            std::array<int, 3> at{3, 3, 3};
            at[static_cast<std::size_t>(axis)] = i;
            TestVoxel& v = voxels[{at[0], at[1], at[2]}];
            v = even_voxel(0.9, one_lobe());
            const double c = 0.05 + 0.01 * (i + 5 > 20 ? 20 : i + 5);
            (axis == 0 ? v.coverage.x : axis == 1 ? v.coverage.y : v.coverage.z) = share16(c);
            product *= 1.0 - c;
        }
        const VolumeInstance volume = volume_of(voxels, to_world, voxel_size);
        Vec3d from = Vec3d{3.3, 3.6, 3.7} * voxel_size, to = from;
        from[axis] = -20.0 * voxel_size[axis];
        to[axis] = 300.0 * voxel_size[axis];
        const Vec3d a = to_world.point(from), b = to_world.point(to);
        EXPECT_NEAR(passes(volume, ray_along(a, b - a)), product, 1e-3);
        EXPECT_NEAR(passes(volume, ray_along(b, a - b)), product, 1e-3);
        Ray shorter = ray_along(a, b - a);
        shorter.t_max = static_cast<float>(length(b - a) * 10.0 / 320.0);
        EXPECT_NEAR(passes(volume, shorter), 1.0, 1e-6);
    }
}

TEST(Volume, RowsAlongAnAxisPassTheProductOfTheirVoxels) {
    expect_row({}, {1, 1, 1});
    expect_row({}, {0.02, 0.5, 0.1});
}

TEST(Volume, ScalingAndTurningKeepTransmittance) {
    const Affine stretched{{3, 0, 0}, {0, 0.5, 0}, {0, 0, 20}, {5, -8, 100}};
    const Affine sheared{{1, 0.4, 0}, {-0.3, 2, 0.1}, {0, 0, -0.7}, {1, 2, 3}};
    expect_row(stretched, {1, 1, 1});
    expect_row(sheared, {0.02, 0.5, 0.1});
}

TEST(Volume, ATurnedInstanceIsTheTurnedInput) { // by 90 degrees about z: (x, y) to (-y, x)
    const VoxelMap voxels = cloud();
    VoxelMap turned;
    for (const auto& [at, v] : voxels) {
        const auto [x, y, z] = at;
        TestVoxel& t = turned[{-1 - y, x, z}];
        t = v;
        std::swap(t.coverage.x, t.coverage.y);
    }
    const Affine turn{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {}};
    const VolumeInstance instance = volume_of(voxels, turn);
    const VolumeInstance input = volume_of(turned);
    StreamRandom random{5};
    for (int i = 0; i < 200; ++i) {
        const Vec3d at = to_double(random_direction(random)) * 4.0;
        const Vec3d d = to_double(random_direction(random));
        EXPECT_NEAR(passes(instance, ray_along(at, d)), passes(input, ray_along(at, d)), 2e-5);
    }
}

TEST(Volume, FlightsEndAsTransmittanceSays) {
    const VolumeInstance volume = volume_of(cloud(), {{1, 0, 0}, {0, 2, 0}, {0, 0, 1}, {}});
    StreamRandom directions{7};
    for (int r = 0; r < 4; ++r) {
        Ray ray = ray_along(to_double(random_direction(directions)) * (r == 0 ? 2.0 : 20.0), {});
        ray.direction =
            normalize(to_float(ray.origin * -1.0) + random_direction(directions) * 0.2f);
        constexpr int kBins = 40, kFlights = 20000;
        std::vector<double> expected, observed(kBins + 1);
        double before = 1.0;
        for (int i = 0; i < kBins; ++i) {
            ray.t_max = static_cast<float>(i + 1);
            const double after = passes(volume, ray);
            expected.push_back(kFlights * (before - after));
            before = after;
        }
        expected.push_back(kFlights * before);
        ray.t_max = std::numeric_limits<float>::infinity();
        StreamRandom random{100 + static_cast<std::uint64_t>(r)};
        for (int i = 0; i < kFlights; ++i) {
            VolumeHit hit;
            const bool stops = volume.sample_flight(ray, Transport::Product, kFinest, random, hit);
            observed[stops ? std::min(static_cast<std::size_t>(hit.t), std::size_t{kBins})
                           : std::size_t{kBins}] += 1.0;
        }
        std::vector<double> o{0.0}, e{0.0}; // few expected: pooled
        for (std::size_t i = 0; i <= kBins; ++i) {
            const bool few = expected[i] < 8.0;
            if (few) {
                o[0] += observed[i];
                e[0] += expected[i];
            } else {
                o.push_back(observed[i]);
                e.push_back(expected[i]);
            }
        }
        if (e[0] < 1.0) {
            EXPECT_LT(o[0], 8.0);
            o.erase(o.begin());
            e.erase(e.begin());
        }
        EXPECT_LT(chi_squared_z(o, e), kUnlikely);
    }
}

TEST(Volume, FlightsEndInTheVoxelThatTheyName) {
    const VoxelMap voxels = cloud();
    const VolumeInstance volume = volume_of(voxels);
    StreamRandom random{8};
    for (int i = 0; i < 2000; ++i) {
        const Ray ray = ray_along(to_double(random_direction(random)) * 9.0,
                                  to_double(random_direction(random)));
        VolumeHit hit;
        if (!volume.sample_flight(ray, Transport::Product, kFinest, random, hit)) continue;
        const Vec3d at = ray.at(static_cast<double>(hit.t));
        bool found = false; // its own voxel, or one beside where it stands on a face
        for (int c = 0; c < 8; ++c) {
            const auto near = [&](double x, bool up) {
                return static_cast<int>(std::floor(x + (up ? 1e-4 : -1e-4)));
            };
            const Vec3i index{near(at.x, (c & 1) != 0), near(at.y, (c & 2) != 0),
                              near(at.z, (c & 4) != 0)};
            if (!voxels.contains({index.x, index.y, index.z})) continue;
            found = found || hit.leaf->find(index) == hit.voxel;
        }
        EXPECT_TRUE(found);
    }
}

/// Three levels of one plate each, whose transmittance tells which was met.
TraversalLevels plates(Vec3d h = {1, 1, 1}) {
    TraversalLevels pyramid;
    for (int level = 0; level < 3; ++level) {
        VoxelMap voxels;
        const int side = 64 >> level;
        for (int i = 0; i < side * side; ++i) {
            voxels[{0, i / side - side / 2, i % side - side / 2}] =
                even_voxel(0.25 * (level + 1), one_lobe());
        }
        pyramid.push_back(level_of(voxels, h * static_cast<double>(1 << level), level));
    }
    return pyramid;
}

TEST(Volume, AForcedLevelIsTheOneThatIsMet) {
    const VolumeInstance volume(plates(), {}, {0});
    for (int level = 0; level < 3; ++level) {
        EXPECT_NEAR(passes(volume, ray_along({-5, 0.3, 0.3}, {1, 0, 0}), {level, 0.0f, 0.5f}),
                    1.0 - 0.25 * (level + 1), 1e-3);
    }
    EXPECT_NEAR(passes(volume, ray_along({-5, 0.3, 0.3}, {1, 0, 0}), {9, 0.0f, 0.5f}), 0.25, 1e-3);
}

TEST(Volume, AMissingLevelGivesTheNextCoarserOne) {
    TraversalLevels pyramid = plates();
    pyramid[0] = nullptr;
    const Ray ray = ray_along({-5, 0.3, 0.3}, {1, 0, 0});
    EXPECT_NEAR(passes(VolumeInstance(pyramid, {}, {0}), ray), 0.5, 1e-3);
    pyramid[2] = nullptr;
    EXPECT_NEAR(passes(VolumeInstance(pyramid, {}, {0}), ray, {2, 0.0f, 0.5f}), 0.5, 1e-3);
}

TEST(Volume, AFractionalLevelIsEitherNeighbourByItsFraction) {
    const Affine doubled{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {}};
    for (const double level : {-2.0, 0.3, 1.0, 1.75, 5.0}) {
        for (const float offset : {0.0f, 0.5f}) {
            const VolumeInstance volume(plates(), doubled, {0});
            Ray ray = ray_along({-5, 0.3, 0.3}, {1, 0, 0});
            ray.width = static_cast<float>(2.0 * std::exp2(level - static_cast<double>(offset)));
            MeanOf mean;
            for (int i = 0; i < 1000; ++i) {
                mean.add(passes(volume, ray, {-1, offset, (static_cast<float>(i) + 0.5f) / 1000}));
            }
            const double inside = std::clamp(level, 0.0, 2.0);
            EXPECT_NEAR(mean.mean(), 0.75 - 0.25 * inside, 2e-3) << level; // linear in the level
        }
    }
}

TEST(Volume, TheLevelFollowsAWideningRay) { // thin sheets, far apart: each met at its own level
    TraversalLevels pyramid;
    for (int level = 0; level < 8; ++level) {
        VoxelMap voxels;
        for (const int x : {0, 1024, 2048, 4096}) {
            voxels[{x >> level, 0, 0}] = even_voxel(0.1 + 0.05 * level, one_lobe());
        }
        pyramid.push_back(level_of(voxels, Vec3d{1, 1, 1} * std::ldexp(1.0, level), level));
    }
    const VolumeInstance volume(std::move(pyramid), {}, {0});
    Ray ray = ray_along({-100, 0.4, 0.4}, {1, 0, 0});
    ray.spread = 1.0f / 100;
    for (int i = 0; i < 200; ++i) {
        const double draw = (i + 0.5) / 200.0;
        double product = 1.0;
        bool between = false; // the level changes inside a sheet
        for (const double width : {1.0, 11.24, 21.48, 41.96}) {
            const int level = static_cast<int>(std::log2(width) + draw);
            between = between || static_cast<int>(std::log2(width * 1.04) + draw) != level;
            product *= 1.0 - (0.1 + 0.05 * level);
        }
        if (between) continue;
        ASSERT_NEAR(passes(volume, ray, {-1, 0.0f, static_cast<float>(draw)}), product, 1e-3) << i;
    }
}

TEST(Volume, WithoutVoxelsItPassesEverything) {
    const VolumeInstance volume = volume_of({});
    EXPECT_TRUE(volume.bounds().empty());
    EXPECT_EQ(passes(volume, ray_along({0.1, 0.2, 0.3}, {1, 0.5, 0.25})), 1.0);
    EXPECT_EQ(passes(VolumeInstance({nullptr}, {}, {}), ray_along({0, 0, 0}, {0, 0, 1})), 1.0);
}

TEST(Volume, BoundsAndVoxelSizeAreOfTheWorld) {
    VoxelMap voxels;
    voxels[{-1, 0, 2}] = even_voxel(0.5, one_lobe());
    const Affine placed{{0, 2, 0}, {-3, 0, 0}, {0, 0, 1}, {10, 0, 0}};
    const VolumeInstance volume = volume_of(voxels, placed, {1, 0.5, 0.25});
    EXPECT_NEAR(volume.voxel_size(), 2.0, 1e-12);
    EXPECT_NEAR(volume.bounds().lo.x, 10.0 - 1.5, 1e-12);
    EXPECT_NEAR(volume.bounds().hi.x, 10.0, 1e-12);
    EXPECT_NEAR(volume.bounds().lo.y, -2.0, 1e-12);
    EXPECT_NEAR(volume.bounds().hi.z, 0.75, 1e-12);
}

struct Drawn {
    MeanOf first; ///< 1 where the axis is nearer to x than to y
    SymmetricMatrix moment{};
};

/// What `scatter` draws of one voxel seen from `wi`.
Drawn draw_axes(const VolumeInstance& volume,
                Vec3f wi,
                const ScatterMaterial& material,
                int count) {
    Drawn out;
    StreamRandom random{12};
    const std::vector<ScatterMaterial> materials{{}, material};
    VolumeHit hit;
    hit.leaf = volume.pyramid()[0]->find_leaf({0, 0, 0}).leaf;
    hit.voxel = hit.leaf->find({0, 0, 0});
    for (int i = 0; i < count; ++i) {
        const VolumeScatter drawn = volume.scatter(hit, wi, materials, random);
        const Scatterer& s = drawn.scatterer;
        EXPECT_EQ(drawn.material, 1u);
        EXPECT_NEAR(length(s.axis), 1.0f, 1e-4f);
        EXPECT_NEAR(dot(s.axis, s.tangent), 0.0f, 1e-4f);
        out.first.add(std::fabs(s.axis.x) > std::fabs(s.axis.y) ? 1.0 : 0.0);
        const float w = 1.0f / static_cast<float>(count);
        out.moment.xx += w * s.axis.x * s.axis.x;
        out.moment.yy += w * s.axis.y * s.axis.y;
        out.moment.zz += w * s.axis.z * s.axis.z;
    }
    return out;
}

VolumeInstance two_lobes(MaterialKind kind, const Affine& to_world = {}) {
    VoxelMap voxels;
    voxels[{0, 0, 0}] =
        even_voxel(0.5, {{needle({1, 0, 0}, 0.05f), 170, 0}, {needle({0, 1, 0}, 0.05f), 85, 0}});
    return {{level_of(voxels, {1, 1, 1}, 0, kind)}, to_world, {1}};
}

TEST(Volume, LobesAreDrawnByWeightAndByHowMuchOfThemIsSeen) {
    ScatterMaterial fiber;
    fiber.model = ScatterModel::LambertFiber;
    const VolumeInstance fibers = two_lobes(MaterialKind::Fiber);
    // from z both needles are seen in full; halfway to y the second is seen by 0.707
    EXPECT_NEAR(draw_axes(fibers, {0, 0, 1}, fiber, 20000).first.mean(), 2.0 / 3.0, 0.015);
    const Vec3f aside = normalize(Vec3f{0, 1, 1});
    EXPECT_NEAR(draw_axes(fibers, aside, fiber, 20000).first.mean(), 2.0 / (2.0 + 0.707), 0.015);

    const VolumeInstance normals = two_lobes(MaterialKind::Surface);
    ScatterMaterial surface;
    const Vec3f flat = normalize(Vec3f{1, 2, 0}); // cosines 1 : 2 against weights 2 : 1
    EXPECT_NEAR(draw_axes(normals, flat, surface, 20000).first.mean(), 0.5, 0.015);
}

TEST(Volume, InstancesTurnWhatTheyScatterWith) {
    const Affine turn{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {}}; // x to y
    for (const MaterialKind kind : {MaterialKind::Fiber, MaterialKind::Surface}) {
        for (const ScatterModel model :
             {ScatterModel::LambertFiber, ScatterModel::MicroflakeDiffuse}) {
            ScatterMaterial material;
            material.model = model;
            const Vec3f wi = normalize(Vec3f{0.3f, 0.5f, 0.8f});
            const Vec3f turned = to_float(turn.direction(to_double(wi)));
            const Drawn a = draw_axes(two_lobes(kind), wi, material, 20000);
            const Drawn b = draw_axes(two_lobes(kind, turn), turned, material, 20000);
            EXPECT_NEAR(a.moment.xx, b.moment.yy, 0.02f);
            EXPECT_NEAR(a.moment.yy, b.moment.xx, 0.02f);
            EXPECT_NEAR(a.moment.zz, b.moment.zz, 0.02f);
        }
    }
}

TEST(Volume, SurfacesAreMetOnTheViewersSide) {
    const VolumeInstance volume = two_lobes(MaterialKind::Surface);
    StreamRandom random{13};
    VolumeHit hit;
    hit.leaf = volume.pyramid()[0]->find_leaf({0, 0, 0}).leaf;
    const std::vector<ScatterMaterial> materials(2);
    for (int i = 0; i < 200; ++i) {
        const Vec3f wi = random_direction(random);
        EXPECT_GE(dot(volume.scatter(hit, wi, materials, random).scatterer.axis, wi), 0.0f);
    }
}

} // namespace
} // namespace heddle
