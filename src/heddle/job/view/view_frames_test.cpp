#include <heddle/job/view/view_frames.h>

#include <heddle/io/image/image.h>
#include <heddle/job/generate_geometry.h>
#include <heddle/job/option_error.h>
#include <heddle/job/test_job.h>

#include <gtest/gtest.h>

namespace heddle::job {
namespace {

using heddle::testing::TempFolder;

TEST(ViewFrames, ThePicturesInFilesAreThoseInMemory) {
    const TempFolder folder;
    Progress silent;
    generate_to_file({.nx = 2, .ny = 2}, folder.file("a.bcc"), silent);
    const ViewOptions options{.width = 32, .height = 24};
    const LoadedView view =
        load_view({.path = folder.file("a.bcc"), .geometry = {}, .folder = folder.file("out")},
                  options, silent);
    EXPECT_EQ(view.subject.name, "a");
    const std::vector<viewer::RgbImage> images = draw_frames(view.subject, options, 2, silent);
    const FramesReport report = draw_frames_to_files(view.subject, options, {.frames = 2}, silent);
    ASSERT_EQ(images.size(), 2u);
    EXPECT_EQ(read_image(folder.file("out/frame_0001.png")).texels, images[1].rgb);
    EXPECT_GT(report.slices, 0);
    test::CancelAt progress(0);
    EXPECT_THROW(draw_frames_to_files(view.subject, options, {.frames = 2}, progress), Error);
}

TEST(ViewFrames, WhatDoesNotGoTogetherIsRefusedInWords) {
    const auto refused = [](const ViewInput& input, const ViewOptions& options, bool scene) {
        try {
            check_view(input, options, scene);
        } catch (const OptionError& e) {
            return std::string(e.what());
        }
        return std::string("no error");
    };
    const ViewInput curves{.path = "a.bcc", .geometry = {}};
    EXPECT_EQ(refused(curves, {}, false), "no error");
    EXPECT_EQ(refused(curves, {.color = "level"}, false),
              "`color` level is not available for slices; known: shaded, direction, grid");
    EXPECT_NE(refused(curves, {.color = "grid"}, false), "no error");
    EXPECT_NE(refused(curves, {}, true), "no error");
    EXPECT_NE(refused({.path = "a.vdb", .geometry = {}, .volume = "b.vdb"}, {}, false), "no error");
    EXPECT_EQ(refused({.path = "a.vdb", .geometry = {}}, {.color = "level"}, true), "no error");
    EXPECT_NE(refused(curves, {.zoom = 0.0}, false), "no error");
}

} // namespace
} // namespace heddle::job
