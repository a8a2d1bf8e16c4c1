#include <heddle/cli/terminal/progress_bar.h>

#include <gtest/gtest.h>

#include <csignal>

namespace heddle::cli {
namespace {

TEST(ProgressBar, HandsNotesOn) {
    std::vector<std::string> notes;
    ProgressBar bar(false, [&](const std::string& note) { notes.push_back(note); });
    bar.begin("read", "files", 1);
    bar.note("radius estimated");
    bar.finish();
    EXPECT_EQ(notes, std::vector<std::string>{"radius estimated"});
    ProgressBar(false).note("to nobody");
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
