#include <heddle/sggx/sample.h>

#include <heddle/sggx/test_lobe.h>

#include <gtest/gtest.h>

#include <numeric>

namespace heddle {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr int kRows = 16;    ///< bins in z
constexpr int kColumns = 32; ///< bins in the angle about z

int bin_of(Vec3d w) {
    const int row = std::min(kRows - 1, static_cast<int>((w.z + 1.0) * 0.5 * kRows));
    const double turn = std::atan2(w.y, w.x) / (2.0 * kPi) + 0.5;
    return row * kColumns + std::min(kColumns - 1, static_cast<int>(turn * kColumns));
}

/// Chi-squared of `observed` against `expected` counts; bins that expect fewer than 5 are pooled.
/// @return  in standard deviations above the mean (Wilson and Hilferty)
double chi_squared_z(const std::vector<double>& observed, const std::vector<double>& expected) {
    double chi = 0.0;
    double pooled_observed = 0.0;
    double pooled_expected = 0.0;
    int degrees = -1;
    const auto add = [&](double o, double e) {
        chi += (o - e) * (o - e) / e;
        ++degrees;
    };
    for (std::size_t i = 0; i < observed.size(); ++i) {
        if (expected[i] >= 5.0) {
            add(observed[i], expected[i]);
        } else {
            pooled_observed += observed[i];
            pooled_expected += expected[i];
        }
    }
    if (pooled_expected >= 5.0) add(pooled_observed, pooled_expected);
    const double k = 2.0 / (9.0 * degrees);
    return (std::cbrt(chi / degrees) - (1.0 - k)) / std::sqrt(k);
}

/// The number of samples that a density per steradian puts into each bin.
template <typename Density>
std::vector<double> expect_counts(const Density& density, int samples) {
    std::vector<double> expected(kRows * kColumns);
    constexpr int kFine = 24; // points per bin along each axis
    for (int i = 0; i < kRows * kFine; ++i) {
        const double z = (2.0 * i + 1.0) / (kRows * kFine) - 1.0;
        const double r = std::sqrt(1.0 - z * z);
        for (int j = 0; j < kColumns * kFine; ++j) {
            const double phi = 2.0 * kPi * (j + 0.5) / (kColumns * kFine);
            const Vec3d w{r * std::cos(phi), r * std::sin(phi), z};
            expected[static_cast<std::size_t>(bin_of(w))] +=
                samples * static_cast<double>(density(to_float(w))) * 4.0 * kPi /
                (kRows * kColumns * kFine * kFine);
        }
    }
    return expected;
}

const Vec3d kShapes[] = {{1, 1, 1}, {1, .5, .2}, {1, .2, .2}, {1, 1, .1}, {1, .3, .1}};

TEST(SampleNdf, SamplesFollowTheDensity) {
    CounterRandom random{4, 1};
    for (const Vec3d& shape : kShapes) {
        const SggxMatrix S = test::random_sggx(shape, random);
        constexpr int kSamples = 200000;
        const std::vector<double> expected =
            expect_counts([&](Vec3f w) { return ndf(S, w); }, kSamples);
        std::vector<double> observed(kRows * kColumns);
        const SggxFactor A = factor(S);
        for (int i = 0; i < kSamples; ++i) {
            observed[static_cast<std::size_t>(bin_of(to_double(sample_ndf(A, random))))] += 1.0;
        }
        EXPECT_LT(chi_squared_z(observed, expected), 4.0) << shape.y << ' ' << shape.z;
    }
}

TEST(SampleNdf, SampledMomentIsTheSecondMoment) {
    CounterRandom random{4, 2};
    for (const Vec3d shape : {Vec3d{1, 1, 1}, Vec3d{1, .5, .02}, Vec3d{1, .01, .01}}) {
        const SggxMatrix S = test::random_sggx(shape, random);
        const SggxFactor A = factor(S);
        std::vector<Vec3d> samples;
        for (int i = 0; i < 200000; ++i) samples.push_back(to_double(sample_ndf(A, random)));
        EXPECT_LT(test::difference(test::pool(samples), second_moment_of(S)), 3e-3);
    }
}

TEST(SampleNdf, MeanCosineIsTheProjectedArea) {
    CounterRandom random{4, 3};
    const SggxMatrix S = test::random_sggx({1, .4, .1}, random);
    const SggxFactor A = factor(S);
    const Vec3d w = test::random_direction(random);
    double sum = 0.0;
    constexpr int kSamples = 200000;
    for (int i = 0; i < kSamples; ++i) sum += std::fabs(dot(to_double(sample_ndf(A, random)), w));
    const double area = projected_area(S, to_float(w));
    EXPECT_NEAR(sum / kSamples, area, 3e-3);
}

TEST(SampleNdf, AMatrixOfRankOneGivesItsAxisAndZeroGivesAUnitVector) {
    CounterRandom random{4, 4};
    const SggxFactor needle = factor({0, 1, 0, 0, 0, 0});
    for (int i = 0; i < 100; ++i) {
        EXPECT_NEAR(std::fabs(sample_ndf(needle, random).y), 1.0f, 1e-6f);
    }
    EXPECT_EQ(length(sample_ndf(factor({}), random)), 1.0f);
}

TEST(SampleVndf, SamplesFollowTheDensityWhichIntegratesToOne) {
    CounterRandom random{4, 5};
    for (const Vec3d& shape : kShapes) {
        const SggxMatrix S = test::random_sggx(shape, random);
        const Vec3f wi = to_float(test::random_direction(random));
        constexpr int kSamples = 200000;
        const std::vector<double> expected =
            expect_counts([&](Vec3f w) { return vndf(S, wi, w); }, kSamples);
        EXPECT_NEAR(std::accumulate(expected.begin(), expected.end(), 0.0) / kSamples, 1.0, 2e-3);
        std::vector<double> observed(kRows * kColumns);
        const SggxFactor A = factor(S);
        for (int i = 0; i < kSamples; ++i) {
            const Vec3f w = sample_vndf(A, wi, random);
            EXPECT_GE(dot(w, wi), -1e-6f);
            observed[static_cast<std::size_t>(bin_of(to_double(w)))] += 1.0;
        }
        EXPECT_LT(chi_squared_z(observed, expected), 4.0) << shape.y << ' ' << shape.z;
    }
}

TEST(SampleVndf, SeenFromAcrossANeedleIsItsAxis) {
    CounterRandom random{4, 6};
    const SggxFactor needle = factor({0, 0, 1, 0, 0, 0});
    const Vec3f wi = normalize(Vec3f{.8f, 0, .6f});
    for (int i = 0; i < 100; ++i) EXPECT_NEAR(sample_vndf(needle, wi, random).z, 1.0f, 1e-6f);
    EXPECT_NEAR(length(sample_vndf(factor({}), wi, random)), 1.0f, 1e-6f);
}

} // namespace
} // namespace heddle
