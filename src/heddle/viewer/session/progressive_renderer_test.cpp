#include <heddle/viewer/session/progressive_renderer.h>

#include <heddle/base/error.h>
#include <heddle/opengl/context.h>

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace heddle::viewer {
namespace {

/// Fills the rows within the limit with one colour.
void fill(const RenderTarget& target, float red) {
    target.begin();
    glClearColor(red, 0.0f, 0.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
}

TEST(Refiner, DrawsCoarseThenAllRowsInBands) {
    const opengl::Context context;
    ProgressiveRenderer refiner(100, 64);
    std::vector<bool> coarse;
    const auto draw = [&](const RenderTarget& target, bool is_coarse) {
        coarse.push_back(is_coarse);
        fill(target, is_coarse ? 1.0f : 0.5f);
    };
    EXPECT_TRUE(refiner.work(0.05, draw));
    EXPECT_EQ(refiner.rows_done(), 0);
    EXPECT_LT(refiner.coarse().width(), 100);
    std::int32_t before = 0;
    while (!refiner.done()) {
        EXPECT_TRUE(refiner.work(0.05, draw));
        EXPECT_GT(refiner.rows_done(), before);
        before = refiner.rows_done();
    }
    EXPECT_EQ(before, 64);
    EXPECT_FALSE(refiner.work(0.05, draw));
    EXPECT_EQ(std::count(coarse.begin(), coarse.end(), true), 1);
    const std::vector<float> pixels = refiner.fine().read();
    for (std::size_t i = 0; i < pixels.size(); i += 4) ASSERT_EQ(pixels[i], 0.5f) << i;
}

TEST(Refiner, ASlowPictureBecomesCoarserUntilItIsInTime) {
    const opengl::Context context;
    ProgressiveRenderer refiner(640, 640);
    const auto draw = [&](const RenderTarget& target, bool) {
        const double seconds = 4e-6 * target.width() * target.height(); // 1.6 s in all
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
        fill(target, 1.0f);
    };
    for (int moves = 0; moves < 4; ++moves) {
        refiner.restart();
        (void)refiner.work(0.03, draw);
    }
    EXPECT_LE(refiner.coarse().width(), 80);
}

TEST(Refiner, BeginsAgainAfterAFailure) {
    const opengl::Context context;
    ProgressiveRenderer refiner(32, 32);
    const auto fails = [](const RenderTarget&, bool) { throw std::runtime_error("x"); };
    (void)refiner.work(1.0, [](const RenderTarget& target, bool) { fill(target, 1.0f); });
    EXPECT_THROW(refiner.work(1.0, fails), std::runtime_error);
    EXPECT_FALSE(refiner.done());
    std::vector<bool> coarse;
    const auto draw = [&](const RenderTarget& target, bool is_coarse) {
        coarse.push_back(is_coarse);
        fill(target, 0.25f);
    };
    while (!refiner.done()) (void)refiner.work(1.0, draw);
    EXPECT_TRUE(coarse.front());
    for (const float c : refiner.fine().read()) ASSERT_TRUE(c == 0.25f || c == 0.0f || c == 1.0f);
    EXPECT_EQ(refiner.fine().read()[4 * 31], 0.25f) << "no limit was left on";
}

} // namespace
} // namespace heddle::viewer
