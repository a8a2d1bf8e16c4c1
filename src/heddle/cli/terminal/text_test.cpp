#include <heddle/cli/terminal/text.h>

#include <gtest/gtest.h>

namespace heddle::cli {
namespace {

TEST(CliText, NumbersAreReadWholeOrNotAtAll) {
    EXPECT_EQ(parse_integer("12"), 12);
    EXPECT_EQ(parse_integer("-3"), -3);
    EXPECT_FALSE(parse_integer("12x"));
    EXPECT_FALSE(parse_integer("1.5"));
    EXPECT_FALSE(parse_integer(""));
    EXPECT_FALSE(parse_integer("99999999999999999999"));
    EXPECT_EQ(parse_number("1e-3"), 1e-3);
    EXPECT_FALSE(parse_number("nan"));
    EXPECT_FALSE(parse_number("inf"));
    EXPECT_FALSE(parse_number("1,5"));
}

TEST(CliText, BytesTakeBinarySuffixes) {
    EXPECT_EQ(parse_bytes("65536"), 65536);
    EXPECT_EQ(parse_bytes("4G"), std::int64_t{4} << 30);
    EXPECT_EQ(parse_bytes("1500M"), std::int64_t{1500} << 20);
    EXPECT_EQ(parse_bytes("1.5GiB"), std::int64_t{1536} << 20);
    EXPECT_EQ(parse_bytes("8KB"), 8192);
    for (const char* bad : {"", "G", "B", "iB", "-1G", "0", "4X", "nan", "1e300"}) {
        EXPECT_FALSE(parse_bytes(bad)) << bad;
    }
}

TEST(CliText, SplitKeepsEmptyPieces) {
    EXPECT_EQ(split("1,2", ','), (std::vector<std::string>{"1", "2"}));
    EXPECT_EQ(split("1,,", ','), (std::vector<std::string>{"1", "", ""}));
    EXPECT_EQ(split("", ','), (std::vector<std::string>{""}));
}

} // namespace
} // namespace heddle::cli
