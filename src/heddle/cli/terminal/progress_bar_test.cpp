#include <heddle/cli/terminal/progress_bar.h>

#include <gtest/gtest.h>

#include <csignal>
#include <thread>

namespace heddle::cli {
namespace {

TEST(ProgressBar, KeepsTheTimeOfEachStageInOrderAndAddsUpRepeatedOnes) {
    ProgressBar bar(false);
    for (const char* stage : {"bin", "gather", "bin"}) {
        bar.begin(stage, "steps", 10);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        bar.advance(10);
    }
    bar.finish();
    ASSERT_EQ(bar.stages().size(), 2u);
    EXPECT_EQ(bar.stages()[0].first, "bin");
    EXPECT_GE(bar.stages()[0].second, 0.004);
    EXPECT_EQ(bar.stages()[1].first, "gather");
}

TEST(ProgressBar, CountsTheStagesOfEachPartAnew) {
    ProgressBar bar(false);
    for (const char* part : {"frame 1 of 2", "frame 2 of 2"}) {
        bar.begin_part(part);
        EXPECT_TRUE(bar.stages().empty());
        bar.begin("read", "files", 1);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    bar.finish();
    ASSERT_EQ(bar.stages().size(), 1u);
    EXPECT_GE(bar.stages()[0].second, 0.002);
}

TEST(ProgressBar, ASignalCancelsTheWork) {
    // never freed: the handler keeps its address
    auto* bar = new ProgressBar(false);
    cancel_on_signals(*bar);
    EXPECT_NO_THROW(bar->check());
    std::raise(SIGINT);
    EXPECT_THROW(bar->check(), Error);
    std::signal(SIGTERM, SIG_DFL);
}

} // namespace
} // namespace heddle::cli
