#include <heddle/stage/render_job.h>

#include <heddle/io/exr/exr.h>
#include <heddle/stage/test_stage.h>

#include <gtest/gtest.h>

#include <filesystem>

namespace heddle {
namespace {

using namespace heddle::testing;

class RenderJobTest : public ::testing::Test {
protected:
    RenderJobTest() : scene_(slab_scene(folder_)) {
        job_.samples = 9;
        job_.scene_hash = 5;
    }
    RenderOutcome render(const std::string& name, Progress& progress) {
        job_.output = folder_.file(name);
        Stage stage(scene_, {false, 0.0f, 100}, progress);
        return render_to_file(stage, {}, 3, scene_.width, scene_.height, job_, progress);
    }
    [[nodiscard]] bool exists(const std::string& name) const {
        return std::filesystem::exists(folder_.file(name));
    }
    TempFolder folder_;
    Scene scene_;
    RenderJob job_;
};

/// Stops in the pass of that number, from 1; what is there when levels are read is noted.
struct Watch final : Progress {
    int stop_in = 0, passes = 0;
    std::string output;
    bool picture_came_first = false;
    void begin(std::string_view stage, std::string_view, std::int64_t) override {
        if (stage == "render") ++passes;
        if (stage == "read levels") picture_came_first = std::filesystem::exists(output);
    }
    void advance(std::int64_t) override {
        if (passes == stop_in) cancel();
    }
};

TEST_F(RenderJobTest, StoppedAndResumedItGivesTheBitsOfOneGo) {
    scene_.width = 2048; // 128 tiles: each thread stops after its first, so some are left
    scene_.height = 1;
    Progress whole;
    EXPECT_EQ(render("whole.exr", whole).samples, 9);
    Watch watch;
    watch.stop_in = 4; // after the coarse one, 1 and 2 samples
    const auto stopped = error_of([&] { render("part.exr", watch); });
    ASSERT_TRUE(stopped.has_value());
    EXPECT_EQ(stopped->code(), ErrorCode::Cancelled);
    EXPECT_TRUE(exists("part.exr"));
    ASSERT_TRUE(exists("part.exr.checkpoint"));
    job_.resume = true;
    Progress rest;
    const RenderOutcome outcome = render("part.exr", rest);
    EXPECT_EQ(outcome.resumed_from, 2);
    EXPECT_EQ(outcome.samples, 9);
    EXPECT_EQ(slurp(folder_.file("part.exr")), slurp(folder_.file("whole.exr")));
    EXPECT_FALSE(exists("part.exr.checkpoint"));
}

TEST_F(RenderJobTest, WithoutACheckpointThereIsNothingToResume) {
    job_.resume = true;
    Progress progress;
    const auto error = error_of([&] { render("none.exr", progress); });
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->code(), ErrorCode::NotFound);
    EXPECT_FALSE(exists("none.exr"));
}

TEST_F(RenderJobTest, ACoarsePictureIsThereBeforeFineLevelsAreRead) {
    Watch watch;
    watch.output = folder_.file("first.exr");
    static_cast<void>(render("first.exr", watch));
    EXPECT_TRUE(watch.picture_came_first);
}

TEST_F(RenderJobTest, StopsByTimeOrNoiseBeforeTheSamplesAreDone) {
    job_.samples = 1 << 20;
    job_.seconds = 1e-6;
    Progress progress;
    EXPECT_LT(render("time.exr", progress).samples, 8);
    job_.seconds = 0.0;
    job_.noise = 10.0;
    EXPECT_EQ(render("noise.exr", progress).samples, 4);
    job_.noise = 0.01;
    const RenderOutcome outcome = render("noise.exr", progress);
    EXPECT_LE(outcome.noise, 0.01);
    EXPECT_GT(outcome.samples, 4);
}

TEST_F(RenderJobTest, WritesPngsToo) {
    job_.samples = 1;
    Progress progress;
    static_cast<void>(render("a.png", progress));
    EXPECT_EQ(slurp(folder_.file("a.png")).substr(1, 3), "PNG");
}

TEST_F(RenderJobTest, ThePictureIsOfTheSlab) { // half as bright as the light around it, or less
    scene_.lights.resize(1);
    job_.samples = 16;
    Progress progress;
    static_cast<void>(render("slab.exr", progress));
    const FloatImage image = read_exr_rgb(folder_.file("slab.exr"));
    ASSERT_EQ(image.width, 24);
    const auto at = [&](int x, int y) {
        return image.values[static_cast<std::size_t>(3 * (y * 24 + x))];
    };
    EXPECT_NEAR(at(0, 0), 1.0f, 1e-3f);
    EXPECT_LT(at(12, 8), 0.8f);
    EXPECT_GT(at(12, 8), 0.2f);
}

} // namespace
} // namespace heddle
