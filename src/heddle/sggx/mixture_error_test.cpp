#include <heddle/sggx/mixture_error.h>

#include <heddle/sggx/test_lobe.h>

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace heddle {
namespace {

constexpr double kPi = 3.141592653589793;

SggxMatrix needle(Vec3d d) {
    return fit_sggx(test::pool({normalize(d)}));
}

DirectionTruth truth_of(const std::vector<Vec3d>& directions) {
    DirectionTruth truth;
    for (const Vec3d& d : directions) truth.add(d, 1.0);
    return truth;
}

double cell_sum(const DirectionTruth& truth) {
    return std::accumulate(truth.cell.begin(), truth.cell.end(), 0.0);
}

TEST(SphereCells, EachHoldsAsManyPointsOfEvenSets) {
    std::vector<int> fine(kSphereCells);
    for (const Vec3d& d : sphere_cell_centers(8 * kSphereCellSide)) ++fine[sphere_cells_of(d).cell];
    for (const int n : fine) EXPECT_EQ(n, 64);
    std::vector<int> even(kSphereCells);
    for (const Vec3d& d : test::sphere(kSphereCells * 1000)) ++even[sphere_cells_of(d * 3.0).cell];
    for (const int n : even) EXPECT_NEAR(n, 1000, 25);
}

TEST(SphereCells, CentersLieInTheirCellsAndOppositesOppose) {
    const std::vector<Vec3d> centers = sphere_cell_centers(kSphereCellSide);
    ASSERT_EQ(centers.size(), static_cast<std::size_t>(kSphereCells));
    for (std::size_t i = 0; i < centers.size(); ++i) {
        const CellPair cells = sphere_cells_of(centers[i]);
        EXPECT_EQ(cells.cell, i);
        EXPECT_EQ(cells.opposite, sphere_cells_of(centers[i] * -1.0).cell);
        EXPECT_NEAR(dot(centers[cells.opposite], centers[i]), -1.0, 1e-12);
    }
}

TEST(SphereCells, PointsOfACellAreNearItsCenter) {
    const std::vector<Vec3d> centers = sphere_cell_centers(kSphereCellSide);
    CounterRandom random{12, 1};
    for (int i = 0; i < 100000; ++i) {
        const Vec3d d = test::random_direction(random);
        EXPECT_GT(dot(centers[sphere_cells_of(d).cell], d), std::cos(.132));
    }
    for (const Vec3d d : {Vec3d{0, 0, 1}, {0, 0, -1}, {-1, 0, 0}, {-1, -0.0, 0}, {1, -1e-300, 0}}) {
        EXPECT_LT(sphere_cells_of(d).cell, kSphereCells);
        EXPECT_LT(sphere_cells_of(d).opposite, kSphereCells);
    }
}

TEST(MixtureError, AMixtureIsItself) {
    CounterRandom random{12, 2};
    std::vector<MixtureLobe> mixture;
    DirectionTruth truth;
    for (const Vec3d shape : {Vec3d{1, .01, .01}, {1, .4, .2}, {1, 1, .02}}) {
        mixture.push_back({test::random_sggx(shape, random), 1.0 + test::uniform(random)});
        truth.add(mixture.back());
    }
    const DirectionError error = mixture_error(mixture, truth);
    EXPECT_EQ(error.sigma, 0.0);
    EXPECT_EQ(error.cells, 0.0);
    EXPECT_EQ(error.moment, 0.0);
    for (MixtureLobe& lobe : mixture) lobe.weight *= 5.0; // the scale of weights does not matter
    EXPECT_LT(mixture_error(mixture, truth).cells, 1e-12);
}

TEST(MixtureError, UniformDirectionsFillAllCellsAlike) {
    DirectionTruth truth;
    truth.add(MixtureLobe{{.25f, .25f, .25f, 0, 0, 0}, 1.0});
    for (const double share : truth.cell) EXPECT_NEAR(share, 1.0 / kSphereCells, 1e-7);
    for (const double sigma : truth.sigma) EXPECT_NEAR(sigma, 0.5, 1e-6);
}

TEST(MixtureError, PerpendicularNeedlesFitTheirDirectionsAndOneLobeDoesNot) {
    const Vec3d x = normalize(Vec3d{1, .3, .2});
    const Vec3d y = normalize(cross(x, Vec3d{.3, 1, .1}));
    const DirectionTruth truth = truth_of({x, y});
    const std::vector<MixtureLobe> two{{needle(x), 1.0}, {needle(y), 1.0}};
    EXPECT_LT(mixture_error(two, truth).sigma, 1e-3);
    EXPECT_LT(mixture_error(two, truth).cells, 4e-3); // its tails
    EXPECT_LT(mixture_error(two, truth).moment, 1e-4);
    // all of a needle's weight is elsewhere, except where the ring passes through its cells
    const std::vector<MixtureLobe> one{{fit_sggx(test::pool({x, y})), 2.0}};
    EXPECT_NEAR(mixture_error(one, truth).sigma, .042, .001);
    EXPECT_GT(mixture_error(one, truth).cells, 1.8);
    EXPECT_LT(mixture_error(one, truth).moment, 1e-4);
}

TEST(MixtureError, AConeIsOffByItsKnownArea) {
    const std::vector<Vec3d> cone = test::cone(normalize(Vec3d{1, 2, 3}), kPi / 4, 3600);
    const DirectionTruth truth = truth_of(cone);
    const std::vector<MixtureLobe> one{{fit_sggx(test::pool(cone)), 1.0}};
    EXPECT_NEAR(mixture_error(one, truth).sigma, .026, .001); // docs/sggx.md
}

TEST(MixtureError, CellsOfALobeAreThoseOfItsSamples) {
    CounterRandom random{12, 3};
    for (const Vec3d shape : {Vec3d{1, 1, 1},
                              {1, .5, .2},
                              {1, .08, .08},
                              {1, .05, .05},
                              {1, .002, .002},
                              {1, 1, .01}}) {
        const SggxMatrix S = test::random_sggx(shape, random);
        DirectionTruth lobe;
        lobe.add(MixtureLobe{S, 1.0});
        EXPECT_NEAR(cell_sum(lobe), 1.0, 1e-9);
        DirectionTruth sampled;
        const SggxFactor A = factor(S);
        constexpr int kSamples = 100000;
        for (int i = 0; i < kSamples; ++i) {
            const CellPair cells = sphere_cells_of(to_double(sample_ndf(A, random)));
            sampled.cell[cells.cell] += .5;
            sampled.cell[cells.opposite] += .5;
        }
        sampled.weight = kSamples;
        // counts of mean n stray by about 0.8 sqrt n, and pairs of cells are counted together
        double noise = 0.0;
        for (const double share : lobe.cell) noise += .8 * std::sqrt(.5 * share / kSamples);
        EXPECT_LT(direction_error(lobe, sampled).cells, 1.4 * 1.5 * noise + 2e-3) << shape.y;
    }
}

TEST(MixtureError, PointsAndDensityGiveTheSameCells) {
    CounterRandom random{12, 4};
    const SggxMatrix S = test::random_sggx({1, .07, .065}, random);
    std::vector<double> points(kSphereCells);
    std::vector<double> density(kSphereCells);
    detail::add_narrow_lobe(S, 1.0, 100000, points.data());
    detail::add_wide_lobe(S, 1.0, density.data());
    double distance = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) distance += std::fabs(points[i] - density[i]);
    EXPECT_LT(distance, 8e-3);
}

} // namespace
} // namespace heddle
