#include <heddle/base/show_number.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

TEST(ShowNumber, FixedNumbersHaveTheirDigits) {
    EXPECT_EQ(show_fixed(1.0 / 3.0, 3), "0.333");
    EXPECT_EQ(show_fixed(1e300, 0).size(), 301u);
}

TEST(ShowNumber, LargeNumbersReadShort) {
    EXPECT_EQ(show_count(0), "0");
    EXPECT_EQ(show_count(999), "999");
    EXPECT_EQ(show_count(1000), "1.00 k");
    EXPECT_EQ(show_count(12'400'000), "12.4 M");
    EXPECT_EQ(show_count(999'700), "1.00 M");
    EXPECT_EQ(show_bytes(1'932'735'283), "1.80 GiB");
    EXPECT_EQ(show_bytes(512), "512 B");
    EXPECT_EQ(show_seconds(0.418), "0.42 s");
    EXPECT_EQ(show_seconds(200.2), "3 min 20 s");
    EXPECT_EQ(show_seconds(7500), "2 h 5 min");
}

} // namespace
} // namespace heddle
