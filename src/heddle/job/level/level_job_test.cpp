#include <heddle/job/level/level_plot.h>
#include <heddle/job/level/measure_levels.h>
#include <heddle/job/level/rebuild_levels.h>

#include <heddle/io/vdb/content_hash.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/job/option_error.h>
#include <heddle/job/test_job.h>
#include <heddle/job/voxelize/voxelize.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace heddle::job {
namespace {

using heddle::testing::TempFolder;

/// Two yarns as a .vdb with levels and masks.
class LevelJob : public ::testing::Test {
protected:
    void SetUp() override {
        VoxelizeJobOptions options;
        options.voxels = 40;
        options.keep_masks = true;
        options.device = DeviceChoice::Cpu;
        path_ = folder_.file("a.vdb");
        voxelize_to_file({.geometry = test::two_yarns()}, path_, options, silent_);
    }
    [[nodiscard]] std::string hash_of(const VoxelLevels& levels) {
        write_vdb(levels, folder_.file("memory.vdb"), silent_);
        return content_hash(folder_.file("memory.vdb"));
    }

    TempFolder folder_;
    std::string path_;
    Progress silent_;
};

TEST_F(LevelJob, RebuiltInMemoryAndInAFileTheLevelsAreTheSame) {
    const RebuildLevelsOptions options{.lod = LodMethod::Single, .levels = 2, .lobes = 1};
    const RebuildLevelsResult made = rebuild_levels(read_levels(path_), options, silent_);
    const RebuildLevelsReport report =
        rebuild_levels_to_file(path_, folder_.file("b.vdb"), options, silent_);
    EXPECT_EQ(made.report.counts.levels, 3);
    EXPECT_EQ(report.counts.all_lobes, made.report.counts.all_lobes);
    EXPECT_EQ(content_hash(folder_.file("b.vdb")), hash_of(made.levels));
    rebuild_levels_to_file(path_, folder_.file("c.vdb"), {.exact = true}, silent_);
    EXPECT_EQ(content_hash(folder_.file("c.vdb")), content_hash(path_));
}

TEST_F(LevelJob, WithoutMasksALevelIsApproximateOrRefused) {
    VoxelizeJobOptions options;
    options.voxels = 20;
    options.device = DeviceChoice::Cpu;
    VoxelizeResult plain = voxelize({.geometry = test::two_yarns()}, options, silent_);
    EXPECT_THROW(
        (void)rebuild_levels(voxelize({.geometry = test::two_yarns()}, options, silent_).levels,
                             {.exact = true}, silent_),
        OptionError);
    const RebuildLevelsResult made = rebuild_levels(std::move(plain.levels), {}, silent_);
    EXPECT_TRUE(made.report.approximate);
    EXPECT_EQ(made.report.notes.size(), 1u);
    EXPECT_THROW((void)rebuild_levels({}, {.lobes = 9}, silent_), OptionError);
    EXPECT_THROW((void)rebuild_levels({}, {.levels = -1}, silent_), OptionError);
}

TEST_F(LevelJob, CancelledItLeavesNoFile) {
    test::expect_cancelled(folder_, 1, [&](Progress& progress) {
        rebuild_levels_to_file(path_, folder_.file("b.vdb"), {}, progress);
    });
    test::expect_cancelled(folder_, 1, [&](Progress& progress) {
        (void)measure_levels(path_, {.plot = folder_.file("b.svg")}, progress);
    });
}

TEST_F(LevelJob, MeasuredInMemoryAndInAFileTheyHaveTheSameErrors) {
    const MeasureLevelsOptions options{.methods = {LodMethod::Moments, LodMethod::Naive},
                                       .parents = 20};
    const LevelTable file = measure_levels(path_, options, silent_);
    const LevelTable memory = measure_levels(read_levels(path_), options, silent_);
    EXPECT_EQ(file.file, path_);
    EXPECT_EQ(memory.file, "");
    EXPECT_EQ(file.coverage, CoverageTruth::Union);
    ASSERT_EQ(file.methods.size(), 3u);
    ASSERT_EQ(memory.methods.size(), 3u);
    for (std::size_t m = 0; m < 3; ++m) {
        EXPECT_EQ(memory.methods[m].errors.name, file.methods[m].errors.name);
        ASSERT_FALSE(file.methods[m].errors.levels.empty());
        EXPECT_EQ(memory.methods[m].errors.levels[0].sigma, file.methods[m].errors.levels[0].sigma);
        EXPECT_GT(file.methods[m].bytes_above(), 0);
    }
    EXPECT_THROW((void)measure_levels(path_, {.parents = 0}, silent_), OptionError);
    EXPECT_THROW((void)measure_levels(path_, {.plot = folder_.file("x.png")}, silent_),
                 OptionError);
}

LevelTable table_of(CoverageTruth truth) {
    LevelTable table;
    table.coverage = truth;
    for (const char* name : {"file", "moments"}) {
        LevelErrors level;
        level.level = 1;
        level.sigma = name[0] == 'f' ? 0.25 : 0.0125;
        level.coverage = 0.5;
        table.methods.push_back({std::nullopt, {2000, 1000}, {name, {level, level}}});
    }
    return table;
}

TEST(LevelPlot, HasCoverageWhereItIsKnown) {
    const std::vector<PlotPanel> panels = panels_of(table_of(CoverageTruth::Union));
    ASSERT_EQ(panels.size(), 3u);
    EXPECT_EQ(panels[0].lines[1].y[0], 0.0125);
    EXPECT_NE(panels[0].lines[0].color, panels[0].lines[1].color);
    EXPECT_EQ(panels_of(table_of(CoverageTruth::None)).size(), 2u);
}

TEST(SvgPlot, IsAPictureWithTheLinesNamesAndAllTagsClosed) {
    std::vector<PlotPanel> panels = panels_of(table_of(CoverageTruth::Union));
    panels[0].title = "a < b & c";
    panels[2].lines[0].y[0].reset(); // a gap
    const std::string svg = draw_svg(panels);
    for (const char* text : {"<svg xmlns=\"http://www.w3.org/2000/svg\"", ">moments</text>",
                             ">file</text>", "a &lt; b &amp; c", "#0072b2", "</svg>"}) {
        EXPECT_NE(svg.find(text), std::string::npos) << text;
    }
    EXPECT_EQ(std::count(svg.begin(), svg.end(), '<'), std::count(svg.begin(), svg.end(), '>'));
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(SvgPlot, NothingToShowIsAnEmptyFrame) {
    const std::string svg = draw_svg({{"title", "x", true, {{.name = "a", .y = {0.0, 0.0}}}}});
    EXPECT_NE(svg.find(">title</text>"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

} // namespace
} // namespace heddle::job
