#include <heddle/cli/voxelize/frames.h>

#include <gtest/gtest.h>

namespace heddle::cli {
namespace {

using Numbers = std::vector<std::int64_t>;

TEST(Frames, ARangeHasBothEndsAndSteps) {
    EXPECT_EQ(parse_frames("1-4"), (Numbers{1, 2, 3, 4}));
    EXPECT_EQ(parse_frames("7-7"), (Numbers{7}));
    EXPECT_EQ(parse_frames("0-10:4"), (Numbers{0, 4, 8}));
    EXPECT_EQ(parse_frames("0008-0009"), (Numbers{8, 9}));
    EXPECT_EQ(parse_frames("1-1000000").size(), 1'000'000u);
}

TEST(Frames, WhatIsNoRangeIsRefused) {
    for (const char* text : {"", "1", "1-", "-1", "4-1", "1-4:0", "1-4:", "1-4:2x", "a-b", "1--4",
                             "1-4-5", "1-1000001", "1-9999999999", " 1-2"}) {
        EXPECT_THROW((void)parse_frames(text), UsageError) << text;
    }
}

TEST(Frames, ThePatternsOneNumberIsReplaced) {
    EXPECT_EQ(frame_path("cloth_%04d.bcc", 7, "FILE"), "cloth_0007.bcc");
    EXPECT_EQ(frame_path("%03d/a.vdb", 1234, "FILE"), "1234/a.vdb");
    EXPECT_EQ(frame_path("a%01d", 0, "FILE"), "a0");
}

TEST(Frames, OtherPatternsAreRefused) {
    for (const char* pattern : {"cloth.bcc", "", "%d.bcc", "%4d.bcc", "%04i.bcc", "%04d_%04d.bcc",
                                "%04d%%.bcc", "%0d", "%010d", "%00d", "%", "%04", "a%sb%04d"}) {
        EXPECT_THROW((void)frame_path(pattern, 1, "FILE"), UsageError) << pattern;
    }
}

} // namespace
} // namespace heddle::cli
