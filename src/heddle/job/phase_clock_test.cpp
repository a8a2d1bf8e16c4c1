#include <heddle/job/phase_clock.h>

#include <heddle/job/test_job.h>

#include <gtest/gtest.h>

#include <thread>

namespace heddle::job {
namespace {

TEST(PhaseClock, KeepsTheTimeOfEachPhaseInOrderAndAddsUpRepeatedOnes) {
    Progress silent;
    PhaseClock clock(silent);
    for (const char* phase : {"bin", "gather", "bin"}) {
        clock.begin(phase, "steps", 10);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        clock.advance(10);
    }
    clock.finish();
    ASSERT_EQ(clock.phases().size(), 2u);
    EXPECT_EQ(clock.phases()[0].first, "bin");
    EXPECT_GE(clock.phases()[0].second, 0.004);
    EXPECT_EQ(clock.phases()[1].first, "gather");
    EXPECT_GE(clock.seconds(), 0.006);
}

TEST(PhaseClock, PassesEverythingOnAndIsCancelledWithTheOuterOne) {
    test::CancelAt outer(2);
    PhaseClock clock(outer);
    clock.begin_part("frame 1 of 2");
    std::vector<std::string> kept;
    take_notes(kept, {"radius estimated"}, clock);
    EXPECT_EQ(outer.parts, std::vector<std::string>{"frame 1 of 2"});
    EXPECT_EQ(outer.notes, std::vector<std::string>{"radius estimated"});
    EXPECT_EQ(kept, outer.notes);
    clock.advance(1);
    EXPECT_NO_THROW(clock.check());
    clock.advance(1);
    EXPECT_THROW(clock.check(), Error);
}

} // namespace
} // namespace heddle::job
