#include <heddle/render/flake_grid.h>

#include <heddle/render/path.h>
#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>

#include <gtest/gtest.h>

#include <cmath>

namespace heddle {
namespace {

/// A ball of fibers that turn with x, of radius 5 voxels of size 0.25, thinner towards -x.
MemoryLevel ball() {
    MemoryLevel grid;
    grid.info().lattice = {{0.25, 0.25, 0.25}, 8};
    grid.info().materials.resize(1);
    grid.info().materials[0].kind = MaterialKind::Fiber;
    VoxelBlock& block = grid.blocks.emplace_back();
    for (int leaf = 0; leaf < 8; ++leaf) {
        VoxelLeaf& l = block.leaves.emplace_back();
        l.origin = {(leaf >> 2) * 8 - 8, (leaf >> 1 & 1) * 8 - 8, (leaf & 1) * 8 - 8};
        l.first_voxel = static_cast<std::uint32_t>(block.coverage.size());
        l.first_lobe = l.first_voxel;
        for (int i = 0; i < 512; ++i) {
            const Vec3i p = l.origin + Vec3i{i >> 6, i >> 3 & 7, i & 7};
            const Vec3f c{static_cast<float>(p.x) + 0.5f, static_cast<float>(p.y) + 0.5f,
                          static_cast<float>(p.z) + 0.5f};
            if (length(c) > 5.0f) continue;
            l.active[static_cast<std::size_t>(i >> 6)] |= std::uint64_t{1} << (i & 63);
            const auto cover = static_cast<std::uint16_t>(9000 + 1500 * p.x);
            block.coverage.push_back({cover, cover, cover, cover});
            block.lobe_count.push_back(1);
            const Vec3f d = normalize(Vec3f{0.1f * c.x, 1.0f, 0.3f * c.y});
            block.lobes.push_back(
                {pack(fit_sggx({d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.x * d.z, d.y * d.z})),
                 255, 0});
        }
    }
    grid.info().voxel_count = static_cast<std::int64_t>(block.coverage.size());
    grid.info().lobe_count = grid.info().voxel_count;
    return grid;
}

FlakeField ball_field(float albedo) {
    const Vec3f color{albedo, albedo, albedo};
    return {ball(), std::span(&color, 1)};
}

/// Optical depth by a sum over the field's own floats, each looked up on its own.
double summed_depth(const FlakeField& field, Vec3d origin, Vec3f w, double until) {
    FlakeBlock all;
    constexpr std::int32_t kLow = -8;
    constexpr std::int32_t kSize = 16;
    field.fill({kLow, kLow, kLow}, {kSize, kSize, kSize}, all);
    constexpr int kSteps = 20000;
    double sum = 0.0;
    for (int s = 0; s < kSteps; ++s) {
        const Vec3d p = origin + to_double(w) * (until * (s + 0.5) / kSteps);
        std::array<int, 3> cell{};
        Vec3d f;
        for (int a = 0; a < 3; ++a) {
            const double g = p[a] / 0.25 - 0.5 - kLow;
            cell[static_cast<std::size_t>(a)] = static_cast<int>(std::floor(g));
            f[a] = g - std::floor(g);
        }
        double sigma = 0.0;
        double q = 0.0;
        for (int c = 0; c < 8; ++c) {
            std::size_t at = 0;
            double weight = 1.0;
            for (int a = 2; a >= 0; --a) {
                const int step = c >> a & 1;
                const int i = cell[static_cast<std::size_t>(a)] + step;
                if (i < 0 || i >= kSize) weight = 0.0;
                at = at * kSize + static_cast<std::size_t>(std::clamp(i, 0, kSize - 1));
                weight *= step == 1 ? f[a] : 1.0 - f[a];
            }
            const float area = projected_area(unpack_flake(all.S[at]), w);
            sigma += weight * static_cast<double>(all.sigma_t[at]);
            q += weight * static_cast<double>(area * area);
        }
        sum += sigma * std::sqrt(q) * until / kSteps;
    }
    return sum;
}

struct Mean {
    double sum = 0.0, squares = 0.0;
    int n = 0;
    void add(double x) { sum += x, squares += x * x, ++n; }
    [[nodiscard]] double value() const { return sum / n; }
    [[nodiscard]] double error() const {
        return std::sqrt(std::max(0.0, squares / n - value() * value()) / n);
    }
};

TEST(FlakeMedium, TransmittanceAndFlightsAreThatOfTheIntegral) {
    const FlakeField field = ball_field(0.5f);
    const FlakeMedium medium(std::make_shared<const FlakeGrid>(field), {}, 0);
    const std::array<Vec3d, 3> origins{Vec3d{-3, 0.1, 0.2}, Vec3d{2, -2, -2.5}, Vec3d{0.1, 0.2, 0}};
    const std::array<Vec3f, 3> directions{Vec3f{1, 0, 0}, normalize(Vec3f{-0.8f, 1, 1.2f}),
                                          normalize(Vec3f{0.3f, -1, 0.2f})};
    StreamRandom random{7};
    for (std::size_t i = 0; i < origins.size(); ++i) {
        const double until = 6.0;
        const double expected = std::exp(-summed_depth(field, origins[i], directions[i], until));
        EXPECT_LT(expected, 0.8);
        const Ray ray{origins[i], directions[i], static_cast<float>(until), 0.0f, 0.0f};
        Mean ratio, flights;
        for (int n = 0; n < 200000; ++n) {
            ratio.add(static_cast<double>(medium.transmittance(ray, random)));
            FlakeHit hit;
            flights.add(medium.sample_flight(ray, random, hit) ? 0.0 : 1.0);
        }
        EXPECT_NEAR(ratio.value(), expected, 3.0 * ratio.error() + 2e-4 * expected);
        EXPECT_NEAR(flights.value(), expected, 3.0 * flights.error() + 2e-4 * expected);
    }
}

TEST(FlakeMedium, AMovedInstanceHidesWhatItHidInPlace) {
    const auto grid = std::make_shared<const FlakeGrid>(ball_field(0.5f));
    // twice as large, turned a quarter about z, moved
    const Affine to_world{{0, 2, 0}, {-2, 0, 0}, {0, 0, 2}, {10, 0, -4}};
    const FlakeMedium placed(grid, to_world, 0);
    const FlakeMedium original(grid, {}, 0);
    const Vec3d from{-3, 0.1, 0.2};
    const Vec3f w = normalize(Vec3f{1, 0.2f, 0.1f});
    const Vec3f w_world = to_float(normalize(to_world.direction(to_double(w))));
    StreamRandom random{3};
    Mean a, b;
    for (int n = 0; n < 100000; ++n) {
        a.add(static_cast<double>(original.transmittance({from, w, 8.0f, 0, 0}, random)));
        b.add(static_cast<double>(
            placed.transmittance({to_world.point(from), w_world, 16.0f, 0, 0}, random)));
    }
    EXPECT_NEAR(b.value(), a.value(), 3.0 * std::hypot(a.error(), b.error()));
    // its flakes turn with it
    FlakeHit hit{1.0f, {1.0f, 0.2f, 0.1f, 0.05f, 0.0f, 0.02f}, {}};
    const SggxMatrix S = placed.scatterer(hit, w_world).lobe;
    EXPECT_NEAR(projected_area(S, w_world) * 2.0f, projected_area(hit.S, w), 1e-5f);
}

TEST(FlakeMedium, WhiteFlakesInAWhiteSkyAreNotSeen) {
    PathScene scene;
    scene.flakes.emplace_back(std::make_shared<const FlakeGrid>(ball_field(1.0f)), Affine{}, 0u);
    scene.materials.resize(1);
    scene.lights = LightSet({Light{}}, 2.0);
    PathOptions options;
    options.max_depth = 10000;
    options.with_transmittance = false;
    Mean mean;
    for (std::uint32_t n = 0; n < 20000; ++n) {
        PathSampler sampler(1, n, n);
        const auto [u, v] = sampler.pair();
        const Ray ray{{-3, 1.2 * static_cast<double>(u) - 0.6, 1.2 * static_cast<double>(v) - 0.6},
                      {1, 0, 0}};
        mean.add(static_cast<double>(trace_path(scene, options, ray, sampler).radiance.y));
    }
    EXPECT_LT(mean.error(), 0.01);
    EXPECT_NEAR(mean.value(), 1.0, 3.0 * mean.error() + 1e-4);
}

} // namespace
} // namespace heddle
