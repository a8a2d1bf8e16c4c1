#include <heddle/sggx/pack.h>

#include <heddle/sggx/test_lobe.h>

#include <gtest/gtest.h>

#include <limits>

namespace heddle {
namespace {

constexpr long double kPi = 3.14159265358979323846L;

/// Determinant of the correlations from half the sum of the angles: exactly 0 on the border.
bool definite_by_determinant(const PackedSggx& p) {
    for (int i = 0; i < 3; ++i) {
        if (p.sigma[i] == 0 || p.r[i] > 254) return false;
    }
    const long double a = std::cos(kPi * p.r[0] / 254), b = std::cos(kPi * p.r[1] / 254),
                      c = std::cos(kPi * p.r[2] / 254);
    // r = -cos: 1 + 2 r r r - ... with the sign of the triple product reversed
    return a * a < 1 - 1e-12L && 1 - 2 * a * b * c - a * a - b * b - c * c > 1e-10L;
}

/// As a renderer uses S: Cholesky in float.
bool has_float_cholesky(const SggxMatrix& S) {
    const float a = std::sqrt(S.xx);
    const float b = S.xy / a;
    const float c = S.xz / a;
    const float d = S.yy - b * b;
    const float e = (S.yz - b * c) / std::sqrt(d);
    return S.xx > 0.0f && d > 0.0f && S.zz - c * c - e * e > 0.0f;
}

void expect_definite(const SggxMatrix& S) {
    const PackedSggx p = pack(S);
    ASSERT_TRUE(is_positive_definite(p));
    ASSERT_TRUE(definite_by_determinant(p));
    ASSERT_GT(decompose(unpack(p)).value[2], 0.0);
    ASSERT_TRUE(has_float_cholesky(unpack(p)));
}

TEST(Pack, EveryLobeDecodesPositiveDefinite) {
    CounterRandom random{3, 1};
    for (int i = 0; i < 100000; ++i) {
        const double u = test::uniform(random);
        const double v = test::uniform(random);
        expect_definite(test::random_sggx(
            {1.0, std::max(u * u, 1.0 / 510), std::max(u * u * v * v, 1.0 / 510)}, random));
    }
}

TEST(Pack, EveryRotatedNeedleAndDiscDecodesPositiveDefinite) {
    CounterRandom random{3, 2};
    for (int i = 0; i < 20000; ++i) {
        expect_definite(fit_sggx(test::rotate({1, 0, 0}, random)));
        expect_definite(fit_sggx(test::rotate({1, 1, 0}, random)));
        expect_definite(fit_sggx(test::rotate({1, random.uniform(), 0}, random)));
        expect_definite(test::rotate({1, 0, 0}, random)); // exactly singular
    }
    const float third = 1.0f / 3.0f;
    expect_definite({third, third, third, third, third, third});
    expect_definite({third, third, third, -third, third, -third});
    expect_definite({.5f, .5f, 0, .5f, 0, 0});
}

TEST(Pack, WhatIsNoDistributionStillDecodesPositiveDefinite) {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInf = std::numeric_limits<float>::infinity();
    expect_definite({});
    expect_definite({-1, -1, -1, 1, 1, 1});
    expect_definite({.3f, .3f, .3f, -.3f, -.3f, -.3f});
    expect_definite({kNaN, kNaN, kNaN, kNaN, kNaN, kNaN});
    expect_definite({kInf, 1, 1, kInf, -kInf, kNaN});
    expect_definite({9, 9, 9, 99, 99, -99});
}

TEST(Pack, PackedBytesComeBackUnchanged) {
    CounterRandom random{3, 3};
    for (int i = 0; i < 100000; ++i) {
        const PackedSggx p = pack(test::random_sggx(
            {1.0, .05 + .95 * test::uniform(random), .05 + .95 * test::uniform(random)}, random));
        ASSERT_EQ(pack(unpack(p)), p);
    }
}

TEST(Pack, DefinitenessOfAnyBytesAgreesWithTheDeterminant) {
    CounterRandom random{3, 4};
    int definite = 0;
    for (int i = 0; i < 300000; ++i) {
        std::uint64_t bits = random.next();
        PackedSggx p;
        for (std::uint8_t& s : p.sigma) s = static_cast<std::uint8_t>(bits & 255), bits >>= 8;
        for (std::uint8_t& r : p.r) r = static_cast<std::uint8_t>(bits & 255), bits >>= 8;
        if (i % 8 == 0) p.sigma[i / 8 % 3] = 0;
        if (i % 9 == 0) p.r[i / 9 % 3] = (i & 1) != 0 ? 255 : 0;
        ASSERT_EQ(is_positive_definite(p), definite_by_determinant(p));
        definite += is_positive_definite(p) ? 1 : 0;
    }
    EXPECT_GT(definite, 60000);
    EXPECT_LT(definite, 250000);
}

TEST(Pack, ASemiDefiniteMatrixAlwaysHasADefiniteNeighbour) {
    CounterRandom random{3, 6};
    for (int i = 0; i < 300000; ++i) { // exactly singular, many on a corner of the angles' lattice
        const SymmetricMatrix d =
            test::rotate({1, i % 3 == 0 ? 0.0 : test::uniform(random), 0}, random);
        const Vec3f product{std::sqrt(d.xx * d.yy), std::sqrt(d.xx * d.zz), std::sqrt(d.yy * d.zz)};
        PackedSggx p;
        ASSERT_TRUE(detail::store_correlations(
            {d.xy / product.x, d.xz / product.y, d.yz / product.z}, product, p));
    }
    for (int a = 0; a <= kAngleSteps; ++a) {
        for (int b = 0; a + b <= kAngleSteps; ++b) {
            PackedSggx p;
            const float x = detail::cosine_of(a), y = detail::cosine_of(b);
            ASSERT_TRUE(detail::store_correlations({x, y, detail::cosine_of(a + b)}, {1, 1, 1}, p));
            ASSERT_TRUE(
                detail::store_correlations({-x, -y, detail::cosine_of(a + b)}, {1, 1, 1}, p));
        }
    }
}

TEST(Pack, TheMomentOfANeedleComesBackWithinHalfAPercent) {
    CounterRandom random{3, 7};
    for (int i = 0; i < 20000; ++i) {
        const SymmetricMatrix M = test::rotate({1, 0.01 * test::uniform(random), 0}, random);
        const float trace = M.xx + M.yy + M.zz;
        const SymmetricMatrix mean{M.xx / trace, M.yy / trace, M.zz / trace,
                                   M.xy / trace, M.xz / trace, M.yz / trace};
        ASSERT_LT(test::difference(second_moment_of(unpack(pack(fit_sggx(M)))), mean), 0.005);
    }
}

TEST(Pack, EveryEntryStaysWithinAByteStep) {
    CounterRandom random{3, 5};
    for (int i = 0; i < 100000; ++i) {
        const SggxMatrix S = test::random_sggx(
            {1.0, .2 + .8 * test::uniform(random), .2 + .8 * test::uniform(random)}, random);
        ASSERT_LT(test::difference(unpack(pack(S)), S), 1.05 / 127.0);
    }
}

} // namespace
} // namespace heddle
