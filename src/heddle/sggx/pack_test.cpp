#include <heddle/sggx/pack.h>

#include <heddle/sggx/test_lobe.h>

#include <gtest/gtest.h>

#include <limits>

namespace heddle {
namespace {

/// Sylvester's rule on 255^2 S, whose minors are integers below 2^63 times 255 to a power.
bool definite_by_minors(const PackedSggx& p) {
    using Wide = long double; // 64-bit mantissa: the integers below stay exact
    const auto entry = [&](int i, int j, int k) {
        return static_cast<Wide>(p.sigma[i]) * p.sigma[j] * (i == j ? 255 : 2 * p.r[k] - 255);
    };
    const Wide xx = entry(0, 0, 0), yy = entry(1, 1, 0), zz = entry(2, 2, 0);
    const Wide xy = entry(0, 1, 0), xz = entry(0, 2, 1), yz = entry(1, 2, 2);
    return xx > 0 && xx * yy - xy * xy > 0 &&
           xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz) > 0;
}

/// What a renderer does with S: Cholesky in float.
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
    ASSERT_GE(detail::correlation_determinant(p.r[0], p.r[1], p.r[2]), kMinPackedDeterminant);
    ASSERT_TRUE(definite_by_minors(p));
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

TEST(Pack, DefinitenessOfAnyBytesAgreesWithTheMinors) {
    CounterRandom random{3, 4};
    int definite = 0;
    for (int i = 0; i < 300000; ++i) {
        std::uint64_t bits = random.next();
        PackedSggx p;
        for (std::uint8_t& s : p.sigma) s = static_cast<std::uint8_t>(bits & 255), bits >>= 8;
        for (std::uint8_t& r : p.r) r = static_cast<std::uint8_t>(bits & 255), bits >>= 8;
        if (i % 8 == 0) p.sigma[i / 8 % 3] = 0;
        if (i % 9 == 0) p.r[i / 9 % 3] = (i & 1) != 0 ? 255 : 0;
        ASSERT_EQ(is_positive_definite(p), definite_by_minors(p));
        definite += is_positive_definite(p) ? 1 : 0;
    }
    EXPECT_GT(definite, 100000);
    EXPECT_LT(definite, 250000);
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
