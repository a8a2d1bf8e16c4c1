#include <heddle/scatter/scatterer.h>

#include <heddle/scatter/longitudinal.h>
#include <heddle/scatter/test_sphere.h>

#include <gtest/gtest.h>

#include <cmath>

namespace heddle {
namespace {

Scatterer hair(Vec3f absorption, float width_m = .3f, float width_n = .3f, float tilt = .035f) {
    ScatterMaterial m;
    m.model = ScatterModel::Hair;
    m.absorption = absorption;
    m.width_m = width_m;
    m.width_n = width_n;
    m.tilt = tilt;
    return test::askew(m);
}

Vec3f inclined(double theta, double turns = .1) {
    return test::Askew{}.world(test::direction(std::sin(theta), turns));
}

TEST(Hair, WithoutAbsorptionSendsAllOutForEveryDirectionAndWidth) {
    for (const float width : {.2f, .5f, 1.0f}) {
        for (const double theta : {0.0, .7, -1.3, 1.55}) {
            const test::Integral sum =
                test::integrate(hair({}, width, width), inclined(theta), 128);
            EXPECT_NEAR(sum.energy[0], 1.0, 5e-3) << width << ' ' << theta;
            EXPECT_NEAR(sum.pdf, 1.0, 5e-3);
        }
    }
}

TEST(Hair, NarrowLobesKeepTheirEnergyInTheirSamples) {
    for (const double theta : {0.0, .9, 1.5}) {
        EXPECT_NEAR(test::mean_weight(hair({}, 0.0f, 0.0f), inclined(theta)).x, 1.0, .01);
    }
}

TEST(Hair, SamplesFollowTheDensity) {
    EXPECT_LT(test::chi_squared_z(hair({.2f, .4f, .8f}), inclined(.3)), test::kUnlikely);
    EXPECT_LT(test::chi_squared_z(hair({}, .6f, .15f), inclined(-1.1)), test::kUnlikely);
    EXPECT_LT(test::chi_squared_z(hair({3, 3, 9}, .4f, .8f), inclined(1.5)), test::kUnlikely);
}

/// The shares of R, TT, TRT and the rest at offset h of a cylinder, and its angles of refraction.
struct Offset {
    double share[4];
    double outside, inside;
};

/// [Chiang16] in double, without cells.
Offset at_offset(double h, double theta, double absorption, double eta) {
    const double s = std::sin(theta);
    const double c = std::cos(theta);
    const double across = std::sqrt(eta * eta - s * s) / c;
    const double cosine = c * std::sqrt(1.0 - h * h);
    const double refracted = std::sqrt(1.0 - (1.0 - cosine * cosine) / (eta * eta));
    const double p = (eta * cosine - refracted) / (eta * cosine + refracted);
    const double q = (cosine - eta * refracted) / (cosine + eta * refracted);
    const double f = .5 * (p * p + q * q);
    const double path =
        std::sqrt(1.0 - h * h / (across * across)) / std::sqrt(1.0 - s * s / (eta * eta));
    const double T = std::exp(-2.0 * absorption * path);
    const double tt = (1.0 - f) * (1.0 - f) * T;
    return {{f, tt, tt * f * T, tt * f * f * T * T / (1.0 - f * T)},
            std::asin(h),
            std::asin(h / across)};
}

double energy_of_cylinder(double theta, double absorption, double eta) {
    double sum = 0.0;
    constexpr int kOffsets = 4000;
    for (int i = 0; i < kOffsets; ++i) {
        for (const double e : at_offset((i + .5) / kOffsets, theta, absorption, eta).share)
            sum += e;
    }
    return sum / kOffsets;
}

TEST(Hair, AbsorbsWhatACylinderDoes) {
    for (const double theta : {0.0, .6, -1.2}) {
        const test::Integral sum = test::integrate(hair({.1f, .5f, 3.0f}), inclined(theta), 128);
        EXPECT_NEAR(sum.energy[0], energy_of_cylinder(theta, .1, 1.55), 8e-3) << theta;
        EXPECT_NEAR(sum.energy[1], energy_of_cylinder(theta, .5, 1.55), 8e-3) << theta;
        EXPECT_NEAR(sum.energy[2], energy_of_cylinder(theta, 3.0, 1.55), 8e-3) << theta;
    }
}

/// The azimuthal part of path p for light at inclination `theta`: a fine sum of wrapped logistics.
double azimuthal_of_cylinder(int p, double phi, double theta, double scale) {
    constexpr int kOffsets = 1500;
    double sum = 0.0;
    for (int i = 0; i < kOffsets; ++i) {
        const Offset o = at_offset((2.0 * i + 1.0) / kOffsets - 1.0, theta, .3, 1.55);
        double x = phi - (2.0 * p * o.inside - 2.0 * o.outside + p * test::kPi);
        x -= 2.0 * test::kPi * std::floor(x / (2.0 * test::kPi) + .5);
        const double e = std::exp(-std::fabs(x) / scale);
        sum += o.share[p] * e / (scale * (1.0 + e) * (1.0 + e)) / kOffsets;
    }
    return sum;
}

TEST(Hair, ItsCellsAreNearAFineSumOverTheOffset) {
    // width_n and the scale of its logistic: sqrt(pi / 8) (0.265 n + 1.194 n^2), the rest < 1e-7
    const double n = .4;
    const double scale = std::sqrt(test::kPi / 8.0) * (.265 * n + 1.194 * n * n);
    const Scatterer at = hair({.3f, .3f, .3f}, .3f, .4f, 0.0f);
    const double root = .726 * .3 + .812 * .09;
    const auto r = static_cast<float>(root * root);
    const float variance[4] = {r, .25f * r, 4.0f * r, 4.0f * r};
    for (const double theta : {0.0, .8}) {
        const detail::Inclination in{static_cast<float>(std::sin(theta)),
                                     static_cast<float>(std::cos(theta))};
        const detail::Inclination out{-in.sin, in.cos};
        double rest = 0.0;
        for (int i = 0; i < 1000; ++i)
            rest += at_offset((i + .5) / 1000, theta, .3, 1.55).share[3] / 1000;
        double error = 0.0;
        double all = 0.0;
        for (int i = 0; i < 64; ++i) {
            const double phi = 2.0 * test::kPi * (i + .3) / 64;
            double sum = rest / (2.0 * test::kPi) *
                         static_cast<double>(detail::longitudinal(in, out, variance[3]));
            for (int p = 0; p < 3; ++p) {
                sum += azimuthal_of_cylinder(p, phi, theta, scale) *
                       static_cast<double>(detail::longitudinal(in, out, variance[p]));
            }
            const Vec3f f = evaluate(at, inclined(theta, 0.0), inclined(-theta, (i + .3) / 64));
            error += std::fabs(static_cast<double>(f.x) - sum);
            all += sum;
        }
        EXPECT_LT(error / all, .01) << theta;
    }
}

TEST(Hair, ReflectionLeansToTheRootByTwiceTheTilt) {
    // black hair has only R: where its mean inclination is, for light perpendicular to the fiber
    Scatterer at = hair({1e4f, 1e4f, 1e4f}, .1f, .3f, .1f);
    double mean = 0.0;
    double all = 0.0;
    test::for_each_cell(192, [&](Vec3f wo, double area, int, int) {
        const double e = area * static_cast<double>(evaluate(at, inclined(0.0), wo).x);
        mean += e * std::asin(static_cast<double>(dot(wo, at.axis)));
        all += e;
    });
    EXPECT_NEAR(mean / all, -.2, .01);
    EXPECT_GT(all, .05);
}

TEST(Hair, ThinColourIsTransmittedForwardAndGlintsComeBack) {
    const Scatterer at = hair({.05f, .5f, 2.0f}, .3f, .2f);
    const Vec3f wi = inclined(0.0, .1);
    const Vec3f forward = evaluate(at, wi, inclined(.03, .6));
    EXPECT_GT(forward.x, 2.0f * forward.z);
    EXPECT_GT(forward.x, 3.0f * evaluate(at, wi, inclined(.03, .35)).x);
    const Vec3f back = evaluate(at, wi, inclined(-.07, .1)); // R is white, TRT is coloured
    EXPECT_LT(back.x / back.z, .3f * forward.x / forward.z);
}

TEST(Hair, IsTheSameOnBothSidesOfTheLight) {
    const Scatterer at = hair({.2f, .4f, .8f});
    for (const double turns : {.03, .2, .41}) {
        const Vec3f a = evaluate(at, inclined(.3, .1), inclined(-.2, .1 + turns));
        const Vec3f b = evaluate(at, inclined(.3, .1), inclined(-.2, .1 - turns));
        EXPECT_NEAR(a.x, b.x, 1e-3f * a.x);
    }
}

} // namespace
} // namespace heddle
