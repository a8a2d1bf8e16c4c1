#include <heddle/base/format_number.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

TEST(FormatNumber, FixedNumbersHaveTheirDigits) {
    EXPECT_EQ(format_fixed(1.0 / 3.0, 3), "0.333");
    EXPECT_EQ(format_fixed(1e300, 0).size(), 301u);
}

TEST(FormatNumber, LargeNumbersReadShort) {
    EXPECT_EQ(format_count(0), "0");
    EXPECT_EQ(format_count(999), "999");
    EXPECT_EQ(format_count(1000), "1.00 k");
    EXPECT_EQ(format_count(12'400'000), "12.4 M");
    EXPECT_EQ(format_count(999'700), "1.00 M");
    EXPECT_EQ(format_bytes(1'932'735'283), "1.80 GiB");
    EXPECT_EQ(format_bytes(512), "512 B");
    EXPECT_EQ(format_seconds(0.418), "0.42 s");
    EXPECT_EQ(format_seconds(200.2), "3 min 20 s");
    EXPECT_EQ(format_seconds(7500), "2 h 5 min");
}

} // namespace
} // namespace heddle
