#include <heddle/geom/color.h>

#include <gtest/gtest.h>

#include <limits>

namespace heddle {
namespace {

std::uint8_t byte_of(int i) {
    return static_cast<std::uint8_t>(i);
}

TEST(Color, EveryByteComesBackThroughLinearLight) {
    for (int i = 0; i < 256; ++i) {
        EXPECT_EQ(srgb_byte(linear_from_srgb_byte<float>(byte_of(i))), i);
        EXPECT_EQ(srgb_byte(linear_from_srgb_byte<double>(byte_of(i))), i);
    }
}

TEST(Color, FloatAndDoubleDecodeToTheSameBytes) {
    for (int i = 0; i < 256; ++i) {
        const double exact = linear_from_srgb_byte<double>(byte_of(i));
        const auto rounded = static_cast<double>(linear_from_srgb_byte<float>(byte_of(i)));
        EXPECT_NEAR(rounded, exact, 2e-7);
        EXPECT_EQ(std::lround(rounded * 255.0), std::lround(exact * 255.0)) << i;
    }
}

TEST(Color, TheCurveGoesThroughItsKnownPoints) {
    EXPECT_EQ(srgb_from_linear(0.0), 0.0);
    EXPECT_NEAR(srgb_from_linear(1.0), 1.0, 1e-15);
    EXPECT_NEAR(srgb_from_linear(0.0031308), 12.92 * 0.0031308, 1e-15);
    EXPECT_NEAR(srgb_from_linear(0.18), 0.4613561295, 1e-9);
    EXPECT_NEAR(linear_from_srgb(0.5), 0.2140411405, 1e-9);
}

TEST(Color, WhatLiesOutsideIsClamped) {
    EXPECT_EQ(srgb_byte(-1.0f), 0);
    EXPECT_EQ(srgb_byte(2.0f), 255);
    EXPECT_EQ(srgb_byte(std::numeric_limits<double>::quiet_NaN()), 0);
    EXPECT_EQ(srgb_byte(std::numeric_limits<double>::infinity()), 255);
}

} // namespace
} // namespace heddle
