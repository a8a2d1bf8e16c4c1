#include <heddle/cli/level_table.h>

#include <gtest/gtest.h>

namespace heddle::cli {
namespace {

job::LevelTable table() {
    job::LevelTable out;
    out.file = "a.vdb";
    out.lod = "moments";
    out.coverage = CoverageTruth::Union;
    out.voxels = 1000;
    out.lobes = 1500;
    out.finest_bytes = 2000;
    LevelErrors level;
    level.level = 1;
    level.voxels = 100;
    level.lobes = 250;
    level.parents = 7;
    level.sigma = 0.0125;
    level.coverage = 0.5;
    out.methods.push_back({std::nullopt, {2000, 1000}, {"file", {level}}});
    level.coverage.reset();
    out.methods.push_back({0.5, {0, 400}, {"naive", {level}}});
    return out;
}

TEST(LevelTable, MarkdownHasARowPerLevelAndMethod) {
    const std::string text = markdown_of(table());
    EXPECT_NE(text.find("| file | - | - | 1000 B | 1.500 |"), std::string::npos) << text;
    EXPECT_NE(text.find("| naive | 0.50 | 0.002 | 400 B | 1.200 |"), std::string::npos) << text;
    EXPECT_NE(text.find("| 1 | file | 100 | 2.500 | 1000 B | 10.0 | 7 | 0.01250 |"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("| 0.00000 | - | - |"), std::string::npos) << text;
    EXPECT_EQ(text.find("kind lost"), std::string::npos);
}

TEST(LevelTable, WhatIsLostHasAColumnWhereSomethingIs) {
    job::LevelTable some = table();
    some.methods[1].errors.levels[0].lost = 0.25;
    EXPECT_NE(markdown_of(some).find("kind lost"), std::string::npos);
}

TEST(LevelTable, JsonHasTheSameNumbersAndNullForWhatIsNotKnown) {
    Report report;
    report.json = true;
    add_json(table(), report);
    report.page("not in JSON");
    testing::internal::CaptureStdout();
    report.print();
    const auto read = nlohmann::json::parse(testing::internal::GetCapturedStdout());
    EXPECT_EQ(read.at("coverage_truth"), "union");
    EXPECT_EQ(read.at("methods").at(1).at("name"), "naive");
    EXPECT_TRUE(read.at("methods").at(0).at("build_seconds").is_null());
    const auto level = read.at("methods").at(1).at("levels").at(0);
    EXPECT_EQ(level.at("sigma_error"), 0.0125);
    EXPECT_EQ(level.at("bytes"), 400);
    EXPECT_TRUE(level.at("coverage_mean").is_null());
}

} // namespace
} // namespace heddle::cli
