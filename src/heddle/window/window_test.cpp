#include <heddle/opengl/context.h>
#include <heddle/window/watched_window.h>

#include <heddle/geom/generate.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <thread>

// These need a display: tests/window_test.sh runs them under Xvfb.

namespace heddle::window {
namespace {

TEST(Window, OpensAnewWhereTheContextIsLostAndEndsWhenItIsCancelled) {
    if (std::getenv("DISPLAY") == nullptr) GTEST_SKIP() << "no display";
    viewer::ViewedObject subject;
    subject.name = "hair";
    subject.geometry = generate({.kind = GenerateKind::Hair, .nx = 4, .ny = 4});
    viewer::Settings settings;
    settings.framed = true;
    settings.yarns.resize(1);
    settings.yarns[0].radius = 2.0;
    Progress progress;
    std::thread closer([&] {
        std::this_thread::sleep_for(std::chrono::seconds(3));
        progress.cancel();
    });
    WindowCounts counts;
    const auto lose_third = [](std::int64_t frame) {
        if (frame == 3) throw opengl::LostContext(ErrorCode::Device, "view: lost");
    };
    EXPECT_NO_THROW(counts = run_watched_window(subject, settings, {.width = 120, .height = 100},
                                                progress, lose_third));
    closer.join();
    EXPECT_EQ(counts.contexts, 2);
}

} // namespace
} // namespace heddle::window
