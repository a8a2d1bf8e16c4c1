#include <heddle/render/volume/test_volume.h>
#include <heddle/render/volume/transport.h>

#include <heddle/base/error.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

using namespace heddle::testing;

/// Random voxels of fibers with random cells.
std::shared_ptr<const TraversalLevel> random_level(int level) {
    VoxelMap voxels;
    StreamRandom random{3};
    add_random(voxels, random, {-3, -3, -3}, 6, 150, 0.6);
    return level_with_cells(
        voxels, 0.02f, [&](std::size_t) { return random.next() | 0x8000100000010001; }, level, 0.4);
}

VolumeInstance volume_with_cells() {
    return {{random_level(0)}, {}, {0}};
}

const LevelChoice kFinest{0, 0.0f, 0.5f};

void expect_equal_laws(const VolumeInstance& volume, const LevelChoice& choice, const Ray& ray) {
    for (const Transport t : {Transport::Product, Transport::Cells}) {
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
    const VolumeInstance volume = volume_with_cells();
    StreamRandom random{11};
    for (int r = 0; r < 6; ++r) {
        const Vec3d from = to_double(random_direction(random)) * (r < 2 ? 1.0 : 8.0);
        Ray ray = ray_along(from, to_double(random_direction(random)) * 2.0 - from);
        ray.t_max = r % 2 == 0 ? 3.0f : 30.0f;
        if (r >= 3) ray.from_fiber = {0.02f, 0.9f - 0.4f * static_cast<float>(r - 3), 2.0f};
        expect_equal_laws(volume, kFinest, ray);
    }
}

TEST(Transport, FlightsPassAsOftenWhereTheLevelChanges) {
    const VolumeInstance volume{{random_level(0), random_level(1)}, {}, {0}};
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
    const VolumeInstance volume = volume_with_cells();
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
    const auto fibers = volume_with_cells().pyramid().front();
    const auto bare = level_of({{{0, 0, 0}, even_voxel(0.5, {{needle({1, 0, 0}), 255, 0}})}});
    EXPECT_EQ(resolve(Transport::Automatic, *fibers), Transport::Cells);
    EXPECT_EQ(resolve(Transport::Product, *fibers), Transport::Product);
    EXPECT_EQ(resolve(Transport::Automatic, *bare), Transport::Product);
    EXPECT_EQ(resolve(Transport::Cells, *bare), Transport::Product);
}

TEST(Transport, NamesAreThoseOfTheEnum) {
    EXPECT_EQ(transport_from(""), Transport::Automatic);
    EXPECT_EQ(transport_from("product"), Transport::Product);
    EXPECT_EQ(transport_from("cells"), Transport::Cells);
    EXPECT_EQ(transport_from("flakes"), Transport::Flakes);
    EXPECT_THROW((void)transport_from("cell"), Error);
}

/// Returns the mean transmittance of rays along an axis over the face of voxel (0, 0, 0), and from
/// `from` to `to` on that axis.
double passes_face(const VolumeInstance& volume, int axis, double from, double to) {
    StreamRandom random{7};
    double sum = 0.0;
    constexpr int kRays = 16; // per axis: 4 in each column of cells
    for (int i = 0; i < kRays * kRays; ++i) {
        Vec3d origin{}, direction{};
        origin[axis] = from;
        origin[(axis + 1) % 3] = (i % kRays + 0.5) / kRays;
        origin[(axis + 2) % 3] = (i / kRays + 0.5) / kRays;
        direction[axis] = 1.0;
        Ray ray = ray_along(origin, direction);
        ray.t_max = static_cast<float>(to - from);
        sum += static_cast<double>(volume.transmittance(ray, Transport::Cells, kFinest, random));
    }
    return sum / (kRays * kRays);
}

TEST(CellLaw, RaysAlongAnAxisMeetTheCoverage) {
    StreamRandom random{13};
    const std::vector<Lobe> lobes{{needle({1, 0, 0}), 255, 0}};
    for (int i = 0; i < 10; ++i) {
        VoxelMap voxels;
        voxels[{0, 0, 0}] = {{share16(0.1 + 0.05 * i), share16(0.5), share16(0.3), 0}, lobes};
        const std::uint64_t cells = random.next() | random.next();
        const VolumeInstance volume{
            {level_with_cells(voxels, 0.01f, [&](std::size_t) { return cells; })}, {}, {0}};
        EXPECT_NEAR(passes_face(volume, 0, -1.0, 2.0), 0.9 - 0.05 * i, 4e-3);
        EXPECT_NEAR(passes_face(volume, 1, -1.0, 2.0), 0.5, 4e-3);
        EXPECT_NEAR(passes_face(volume, 2, -1.0, 2.0), 0.7, 4e-3);
    }
}

TEST(CellLaw, ARowOfTwoVoxelsCoversWhatBothCover) {
    for (const double correlation : {0.0, 0.5, 1.0}) {
        VoxelMap voxels;
        const std::vector<Lobe> lobes{{needle({1, 0, 0}), 255, 0}};
        voxels[{0, 0, 0}] = even_voxel(0.4, lobes);
        voxels[{1, 0, 0}] = even_voxel(0.6, lobes);
        const VolumeInstance volume{
            {level_with_cells(
                voxels, 0.01f, [](std::size_t) { return ~std::uint64_t{0}; }, 0, correlation)},
            {},
            {0}};
        const double independent = 0.4 + 0.6 - 0.4 * 0.6;
        const double both = independent - correlation * (independent - 0.6);
        EXPECT_NEAR(passes_face(volume, 0, -1.0, 3.0), 1.0 - both, 8e-3) << correlation;
        EXPECT_NEAR(passes_face(volume, 1, -1.0, 3.0), 0.6, 4e-3); // alone on this axis
    }
}

TEST(CellLaw, IsTheSameBackwards) {
    const VolumeInstance volume = volume_with_cells();
    StreamRandom random{21};
    for (int i = 0; i < 50; ++i) {
        const Vec3d a = to_double(random_direction(random)) * 8.0;
        const Vec3d b = to_double(random_direction(random)) * 8.0;
        Ray there = ray_along(a, b - a), back = ray_along(b, a - b);
        there.t_max = back.t_max = static_cast<float>(length(b - a));
        const float t = volume.transmittance(there, Transport::Cells, kFinest, random);
        EXPECT_NEAR(volume.transmittance(back, Transport::Cells, kFinest, random), t, 1e-3f);
    }
}

TEST(CellLaw, FlightsStopInSetCells) {
    VoxelMap voxels;
    voxels[{0, 0, 0}] = even_voxel(0.2, {{needle({1, 0, 0}), 255, 0}});
    const std::uint64_t cells = 0x0000ffff00000000; // the layer x = 2
    const VolumeInstance volume{
        {level_with_cells(voxels, 0.01f, [&](std::size_t) { return cells; })}, {}, {0}};
    StreamRandom random{22};
    const Ray ray = ray_along({-1.0, 0.4, 0.6}, {1, 0, 0});
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        VolumeHit hit;
        if (!volume.sample_flight(ray, Transport::Cells, kFinest, random, hit)) continue;
        ++hits;
        EXPECT_GE(hit.t, 1.5f);
        EXPECT_LE(hit.t, 1.75f);
    }
    EXPECT_NEAR(hits / 2000.0, 0.2, 0.04);
}

} // namespace
} // namespace heddle
