#include <heddle/scatter/longitudinal.h>

#include <heddle/scatter/azimuthal.h>

#include <gtest/gtest.h>

#include <cmath>

namespace heddle::detail {
namespace {

Inclination at_angle(double theta) {
    return {static_cast<float>(std::sin(theta)), static_cast<float>(std::cos(theta))};
}

TEST(Approximations, StayWithinTheirBounds) {
    for (double x = -87.0; x < 87.0; x += .0137) {
        const auto f = static_cast<float>(x);
        EXPECT_NEAR(static_cast<double>(exp_approx(f)) / std::exp(static_cast<double>(f)), 1.0,
                    3e-7);
    }
    for (double x = -1.0; x <= 1.0; x += .0007) {
        const auto f = static_cast<float>(x);
        EXPECT_NEAR(static_cast<double>(acos_approx(f)), std::acos(static_cast<double>(f)), 5e-7);
    }
    for (double x = 0.0; x < 60.0; x += .037) {
        const double exact = std::cyl_bessel_i(0.0, x) * std::exp(-x);
        EXPECT_NEAR(static_cast<double>(scaled_bessel_i0(static_cast<float>(x))) / exact, 1.0,
                    1e-6);
    }
    EXPECT_TRUE(std::isfinite(exp_approx(1e30f)));
    EXPECT_LT(exp_approx(-1e30f), 1e-36f);
}

TEST(Longitudinal, IntegratesToOneForEveryConeAndWidth) {
    for (const float v : {kMinVariance, 1e-3f, .04f, .3f, 2.0f, 100.0f}) {
        for (const double theta : {0.0, .3, 1.0, 1.5, 1.5707963}) {
            const Inclination a = at_angle(-theta);
            double sum = 0.0;
            constexpr int kSteps = 40000;
            for (int i = 0; i < kSteps; ++i) {
                const double b = ((i + .5) / kSteps - .5) * 3.141592653589793;
                sum += static_cast<double>(longitudinal(a, at_angle(b), v)) * std::cos(b);
            }
            EXPECT_NEAR(sum * 3.141592653589793 / kSteps, 1.0, 2e-3) << v << ' ' << theta;
        }
    }
}

TEST(Longitudinal, ANarrowLobeIsAGaussianAboutTheMirroredCone) {
    const float v = .0025f; // the square of 0.05 radians
    const Inclination a = at_angle(.4);
    const double peak = static_cast<double>(longitudinal(a, at_angle(-.4), v));
    const double one_off = static_cast<double>(longitudinal(a, at_angle(-.45), v));
    EXPECT_NEAR(one_off / peak, std::exp(-.5), .03);
}

TEST(CircleLogistic, CumulativeIsTheIntegralOfTheDensityAroundTheCircle) {
    for (const float scale : {.02f, .2f, 1.0f, 5.0f}) {
        const CircleLogistic logistic(scale);
        EXPECT_NEAR(logistic.cumulative(3.0f + kTwoPi) - logistic.cumulative(3.0f), 1.0f, 1e-5f);
        EXPECT_NEAR(logistic.cumulative(-kPi + 1e-4f), 0.0f, 1e-3f);
        for (float x = -7.0f; x < 7.0f; x += .37f) {
            const float e = .05f * scale;
            const float slope = (logistic.cumulative(x + e) - logistic.cumulative(x - e)) / (2 * e);
            EXPECT_NEAR(slope, logistic.density(x), 1e-2f * logistic.density(0))
                << scale << ' ' << x;
        }
        for (const float u : {0.0f, .1f, .5f, .9f, .9999999f}) {
            EXPECT_NEAR(logistic.cumulative(logistic.sample(u)), u, 2e-5f);
        }
    }
}

} // namespace
} // namespace heddle::detail
