#include <heddle/viewer/session/save_scene.h>

#include <gtest/gtest.h>

namespace heddle::viewer {
namespace {

TEST(SaveScene, HasTheViewsCameraAndLight) {
    const CameraParameters camera{
        .eye = {1, 2, 3}, .target = {0, 0.5, 0}, .up = {0, 0, 1}, .view_angle = 0.5};
    const std::string text = scene_text("a \"b\".vdb", camera, {0.0, 0.0, 2.0}, 640, 480);
    for (const char* line : {"kind = \"perspective\"", "eye = [1, 2, 3]", "target = [0, 0.5, 0]",
                             "up = [0, 0, 1]", "view_angle = 28.647889", "size = [640, 480]",
                             "direction = [-0, -0, -1]", "volume = \"a \\\"b\\\".vdb\""}) {
        EXPECT_NE(text.find(line), std::string::npos) << line << " in\n" << text;
    }
}

TEST(SaveScene, ParallelRaysHaveAHeight) {
    const CameraParameters camera{.orthographic = true, .view_height = 2.5};
    const std::string text = scene_text("x.vdb", camera, {1.0, 0.0, 0.0}, 10, 10);
    EXPECT_NE(text.find("kind = \"orthographic\""), std::string::npos);
    EXPECT_NE(text.find("view_height = 2.5"), std::string::npos);
    EXPECT_EQ(text.find("view_angle"), std::string::npos);
}

} // namespace
} // namespace heddle::viewer
