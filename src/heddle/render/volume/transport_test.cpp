#include <heddle/render/volume/swept_depth.h>
#include <heddle/render/volume/test_volume.h>
#include <heddle/render/volume/transport.h>

#include <heddle/base/error.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

using namespace heddle::testing;

/// Random voxels with footprints of 4 x 4 cells, as many bits as their coverage rounds to, and
/// random correlation.
std::shared_ptr<const TraversalLevel> random_level(MaterialKind kind, int level) {
    VoxelMap voxels;
    StreamRandom random{3};
    add_random(voxels, random, {-3, -3, -3}, 6, 150, 0.9);
    MemoryLevel grid;
    grid.info().lattice = lattice_of_level({{1, 1, 1}, 8}, level);
    grid.info().level = level;
    grid.info().materials.resize(1);
    grid.info().materials[0].kind = kind;
    grid.info().fields.footprints = 4;
    grid.info().fields.correlation = true;
    grid.blocks = make_blocks(voxels);
    count_voxels(grid);
    for (VoxelBlock& block : grid.blocks) {
        for (const Coverage& c : block.coverage) {
            std::array<std::uint64_t, 3> bits{};
            for (std::size_t a = 0; a < 3; ++a) {
                const double share = (a == 0 ? c.x : a == 1 ? c.y : c.z) / 65535.0;
                while (std::popcount(bits[a]) < std::lround(16.0 * share)) {
                    bits[a] |= std::uint64_t{1} << (random.next() % 16);
                }
            }
            block.footprints.push_back(bits);
            const auto byte = [&] { return static_cast<std::uint8_t>(random.next() % 256); };
            block.correlation.push_back({byte(), byte(), byte()});
        }
    }
    return std::make_shared<const TraversalLevel>(grid);
}

VolumeInstance volume_with_extras(MaterialKind kind = MaterialKind::Fiber) {
    return {{random_level(kind, 0)}, {}, {0}};
}

const LevelChoice kFinest{0, 0.0f, 0.5f};

void expect_equal_laws(const VolumeInstance& volume, const LevelChoice& choice, const Ray& ray) {
    for (const Transport t : {Transport::Product, Transport::Threshold, Transport::Footprint}) {
        StreamRandom random{11};
        constexpr int kDraws = 20000;
        double passed = 0.0, expected = 0.0;
        for (int i = 0; i < kDraws; ++i) {
            VolumeHit hit;
            passed += volume.sample_flight(ray, t, choice, random, hit) ? 0.0 : 1.0;
            expected += static_cast<double>(volume.transmittance(ray, t, choice, random));
        }
        const double share = expected / kDraws;
        const double error = std::sqrt(std::max(share * (1.0 - share), 1e-4) * 2.0 / kDraws);
        EXPECT_NEAR(passed / kDraws, share, 4.0 * error) << static_cast<int>(t);
    }
}

TEST(Transport, FlightsPassAsOftenAsTransmittanceSays) {
    const VolumeInstance volume = volume_with_extras();
    StreamRandom random{11};
    for (int r = 0; r < 6; ++r) {
        const Vec3d from = to_double(random_direction(random)) * (r < 2 ? 1.0 : 8.0);
        Ray ray = ray_along(from, to_double(random_direction(random)) * 2.0 - from);
        ray.t_max = r % 2 == 0 ? 3.0f : 30.0f;
        ray.bulk = r < 3 ? 0.0f : 0.5f;
        expect_equal_laws(volume, kFinest, ray);
    }
}

TEST(Transport, FlightsPassAsOftenWhereTheLevelChanges) {
    const VolumeInstance volume{
        {random_level(MaterialKind::Fiber, 0), random_level(MaterialKind::Fiber, 1)}, {}, {0}};
    StreamRandom random{12};
    for (int r = 0; r < 6; ++r) {
        const Vec3d from = to_double(random_direction(random)) * 6.0;
        Ray ray = ray_along(from, to_double(random_direction(random)) - from);
        ray.width = 0.5f;
        ray.spread = 0.25f; // 2 voxels wide in the middle
        expect_equal_laws(volume, {-1, 0.0f, 0.0f}, ray);
    }
}

TEST(Transport, NothingStopsARayWhereItIsClear) {
    const VolumeInstance volume = volume_with_extras();
    StreamRandom random{5};
    Ray ray = ray_along({0, 0, 0}, {1, 2, 3});
    const auto passes = [&] {
        return volume.transmittance(ray, Transport::Product, kFinest, random);
    };
    const float all = passes();
    EXPECT_LT(all, 0.5f);
    ray.clear = 1.0f;
    EXPECT_GT(passes(), all);
    ray.clear = 20.0f;
    EXPECT_EQ(passes(), 1.0f);
}

TEST(Transport, DataAndMaterialsChooseTheAutomaticOne) {
    const auto fibers = volume_with_extras().pyramid().front();
    const auto surfaces = volume_with_extras(MaterialKind::Surface).pyramid().front();
    const auto bare = level_of({{{0, 0, 0}, even_voxel(0.5, {{needle({1, 0, 0}), 255, 0}})}});
    EXPECT_EQ(resolve(Transport::Automatic, *fibers), Transport::Footprint);
    EXPECT_EQ(resolve(Transport::Automatic, *surfaces), Transport::Product);
    EXPECT_EQ(resolve(Transport::Footprint, *surfaces), Transport::Footprint);
    EXPECT_EQ(resolve(Transport::Automatic, *bare), Transport::Product);
    EXPECT_EQ(resolve(Transport::Footprint, *bare), Transport::Product);
    EXPECT_EQ(resolve(Transport::Threshold, *bare), Transport::Product);
}

TEST(Transport, NamesAreThoseOfTheEnum) {
    EXPECT_EQ(transport_from(""), Transport::Automatic);
    EXPECT_EQ(transport_from("product"), Transport::Product);
    EXPECT_EQ(transport_from("threshold"), Transport::Threshold);
    EXPECT_EQ(transport_from("footprint"), Transport::Footprint);
    EXPECT_THROW((void)transport_from("footprnt"), Error);
}

TraversalVoxel voxel_of(double coverage) {
    const auto depth = static_cast<std::uint16_t>(
        std::lround(-std::log1p(-coverage) / static_cast<double>(kDepthUnit)));
    return {{depth, depth, depth}, 0};
}

double blocked(float depth) {
    return 1.0 - std::exp(-static_cast<double>(depth));
}

TEST(DepthsOnWay, ARayAlongAnAxisIsStoppedInSetCellsAlone) {
    const std::uint64_t along_x = std::uint64_t{1} << (4 * 2 + 1);      // y = 1, z = 2
    const std::uint64_t along_y = std::uint64_t{1} << (16 + 4 * 3 + 0); // z = 0, x = 3
    const std::uint64_t along_z = std::uint64_t{1} << (32 + 4 * 1 + 2); // x = 2, y = 1
    const std::uint64_t bits = along_x | along_y | along_z;
    const TraversalVoxel voxel = voxel_of(1.0 / 16.0);
    const auto cell = [](int i) { return (static_cast<float>(i) + 0.4f) / 4.0f; };
    for (int a = 0; a < 3; ++a) {
        for (int u = 0; u < 4; ++u) {
            for (int v = 0; v < 4; ++v) {
                Vec3f in{}, out{};
                in[(a + 1) % 3] = out[(a + 1) % 3] = cell(u);
                in[(a + 2) % 3] = out[(a + 2) % 3] = cell(v);
                out[a] = 1.0f;
                const bool set = a == 0   ? u == 1 && v == 2
                                 : a == 1 ? u == 0 && v == 3
                                          : u == 2 && v == 1;
                const Vec3f depth = depths_along_path(voxel, bits, 0.0f, 0.0f, in, out);
                EXPECT_NEAR(blocked(depth[a]), set ? 0.99 : 0.0, 0.005);
                EXPECT_EQ(depth[(a + 1) % 3], 0.0f);
            }
        }
    }
}

/// Blocked fraction of a path along z through a part of a uniform voxel.
double blocked_of(double coverage, float part, float many, float bulk) {
    const Vec3f in{0.3f, 0.3f, 0.0f}, out{0.3f, 0.3f, part};
    return blocked(depths_along_path(voxel_of(coverage), 0, many, bulk, in, out).z);
}

TEST(DepthsOnWay, AColumnIsBlockedAtOnePlaceInIt) {
    for (const float part : {0.1f, 0.5f, 1.0f}) {
        EXPECT_NEAR(blocked_of(0.8, part, 0.0f, 0.0f), 0.8 * static_cast<double>(part), 1e-3);
    }
}

TEST(DepthsOnWay, OfManyFibersBehindEachOtherDepthsAddUp) {
    for (const float part : {0.1f, 0.5f, 1.0f}) {
        const double dust = 1.0 - std::pow(0.2, static_cast<double>(part));
        EXPECT_NEAR(blocked_of(0.8, part, 1.0f, 0.0f), dust, 1e-3);
    }
    EXPECT_GT(blocked_of(0.8, 0.5f, 0.3f, 0.0f), 0.4 + 0.02);
    EXPECT_NEAR(blocked_of(0.8, 1.0f, 0.3f, 0.0f), 0.8, 1e-3); // along the axis no difference
}

TEST(DepthsOnWay, InTheBulkTheyAddUpAndAreLarger) {
    for (const float part : {0.1f, 0.5f, 1.0f}) {
        const double bulk = 1.0 - std::pow(0.2, 1.5 * static_cast<double>(part));
        EXPECT_NEAR(blocked_of(0.8, part, 0.0f, 1.0f), bulk, 1e-3);
        EXPECT_NEAR(blocked_of(0.8, part, 0.3f, 1.0f), bulk, 1e-3);
    }
}

TEST(DepthsOnWay, CellsThatRoundingAddedCountLess) {
    const TraversalVoxel voxel = voxel_of(0.10); // two bits cover 0.125
    const Vec3f depth =
        depths_along_path(voxel, 3u << 0, 0.0f, 0.0f, {0, 0.1f, 0.1f}, {1, 0.1f, 0.1f});
    EXPECT_NEAR(blocked(depth.x), 0.8, 1e-3);
}

} // namespace
} // namespace heddle
