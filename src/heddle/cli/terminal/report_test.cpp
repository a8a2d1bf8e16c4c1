#include <heddle/cli/terminal/report.h>

#include <gtest/gtest.h>

namespace heddle::cli {
namespace {

TEST(Report, TheTableIsAlignedAndShort) {
    Report report;
    report.count("voxels", 12'400'000);
    report.bytes("peak memory", std::int64_t{1} << 30);
    testing::internal::CaptureStdout();
    report.print();
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "voxels       12.4 M\n"
                                                      "peak memory  1.00 GiB\n");
}

TEST(Report, JsonHasExactNumbersWithTheUnitInTheKey) {
    Report report;
    report.json = true;
    report.quiet = true;
    report.count("voxels", 12'400'001);
    report.bytes("peak memory", 5);
    report.seconds("read", 0.25);
    report.note("radius estimated");
    testing::internal::CaptureStdout();
    report.print();
    const auto read = nlohmann::json::parse(testing::internal::GetCapturedStdout());
    EXPECT_EQ(read.at("voxels"), 12'400'001);
    EXPECT_EQ(read.at("peak_memory_bytes"), 5);
    EXPECT_EQ(read.at("read_seconds"), 0.25);
    EXPECT_EQ(read.at("notes").at(0), "radius estimated");
}

TEST(Report, ATableInsideIsAlignedByColumn) {
    Report report;
    report.count("voxels", 5);
    report.table("rows", {1, 2}, {"rows", "a", "b"},
                 {{"one", "long cell", "x"}, {"two", "y", "z"}});
    testing::internal::CaptureStdout();
    report.print();
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "voxels  5\n"
                                                      "rows    a          b\n"
                                                      "one     long cell  x\n"
                                                      "two     y          z\n");
    report.json = true;
    testing::internal::CaptureStdout();
    report.print();
    const auto read = nlohmann::json::parse(testing::internal::GetCapturedStdout());
    EXPECT_EQ(read.at("rows").size(), 2u);
}

TEST(Report, QuietPrintsNoTable) {
    Report report;
    report.quiet = true;
    report.count("voxels", 1);
    testing::internal::CaptureStdout();
    report.print();
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

} // namespace
} // namespace heddle::cli
