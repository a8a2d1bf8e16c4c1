#include <heddle/render/camera.h>

#include <gtest/gtest.h>

#include <cmath>

namespace heddle {
namespace {

CameraParameters view_down_z() {
    CameraParameters parameters;
    parameters.eye = {1, 2, 10};
    parameters.target = {1, 2, 0};
    parameters.view_angle = 1.0;
    return parameters;
}

TEST(Camera, TheMiddleOfThePictureLooksAtTheTarget) {
    for (const bool orthographic : {false, true}) {
        CameraParameters parameters = view_down_z();
        parameters.orthographic = orthographic;
        const Ray ray = Camera(parameters, 30, 20).ray(15.0f, 10.0f, {0.5f, 0.5f});
        EXPECT_EQ(ray.direction, (Vec3f{0, 0, -1}));
        EXPECT_EQ(ray.origin, parameters.eye);
    }
}

TEST(Camera, EdgesOfThePictureAreHalfTheViewAngleAway) {
    const Camera camera(view_down_z(), 40, 20);
    const Ray top = camera.ray(20.0f, 0.0f, {});
    EXPECT_NEAR(std::atan2(top.direction.y, -top.direction.z), 0.5, 1e-6);
    EXPECT_NEAR(top.direction.x, 0.0f, 1e-7f);
    const Ray right = camera.ray(40.0f, 10.0f, {}); // square pixels: twice as wide as high
    EXPECT_NEAR(right.direction.x / -right.direction.z, 2.0 * std::tan(0.5), 1e-6);
    EXPECT_GT(right.direction.x, 0.0f);
}

TEST(Camera, SpreadIsTheDistanceOfNeighbouringPixels) {
    const Camera camera(view_down_z(), 640, 480);
    for (const float x : {320.0f, 10.0f}) {
        const Ray a = camera.ray(x, 240.0f, {}), b = camera.ray(x, 241.0f, {});
        const double between = length(a.at(8.0) - b.at(8.0));
        EXPECT_NEAR(static_cast<double>(a.width_at(8.0f)), between, 0.01 * between);
    }
}

TEST(Camera, ParallelRaysAreAPixelApartAndWide) {
    CameraParameters parameters = view_down_z();
    parameters.orthographic = true;
    parameters.view_height = 5.0;
    const Camera camera(parameters, 100, 50);
    const Ray a = camera.ray(3.0f, 7.0f, {}), b = camera.ray(4.0f, 7.0f, {});
    EXPECT_EQ(a.direction, b.direction);
    EXPECT_NEAR(length(a.origin - b.origin), 0.1, 1e-9);
    EXPECT_FLOAT_EQ(a.width, 0.1f);
    EXPECT_EQ(a.spread, 0.0f);
    EXPECT_NEAR(camera.ray(50.0f, 0.0f, {}).origin.y, 2.0 + 2.5, 1e-9);
}

TEST(Camera, ALensIsSharpWhereItIsFocused) {
    CameraParameters parameters = view_down_z();
    parameters.lens_radius = 0.5;
    parameters.focus_distance = 4.0;
    const Camera camera(parameters, 64, 64);
    const Ray sharp = Camera(view_down_z(), 64, 64).ray(50.0f, 12.0f, {});
    const Vec3d focus = sharp.at(4.0 / -static_cast<double>(sharp.direction.z));
    double widest = 0.0;
    for (int i = 0; i < 64; ++i) {
        const Ray ray = camera.ray(
            50.0f, 12.0f, {static_cast<float>(i % 8) / 8.0f, static_cast<float>(i / 8) / 8.0f});
        EXPECT_NEAR(length(ray.at(4.0 / -static_cast<double>(ray.direction.z)) - focus), 0.0, 1e-5);
        EXPECT_NEAR(ray.origin.z, parameters.eye.z, 1e-12);
        const double aside = length(ray.origin - parameters.eye);
        EXPECT_LE(aside, 0.5);
        widest = std::max(widest, aside);
    }
    EXPECT_GT(widest, 0.45);
    parameters.focus_distance = 0.0; // the target's
    const Ray ray = Camera(parameters, 64, 64).ray(32.0f, 32.0f, {0.9f, 0.3f});
    EXPECT_NEAR(length(ray.at(10.0 / -static_cast<double>(ray.direction.z)) - parameters.target),
                0.0, 1e-5);
}

TEST(Frame, SeesAllOfABoxAndLittleMore) {
    Bounds box;
    box.grow(Vec3d{-3, 5, 1});
    box.grow(Vec3d{4, 6, 20});
    for (const Vec3d from : {Vec3d{0.5, 0.35, 1.0}, Vec3d{-1, -0.2, 0.1}}) {
        for (const double aspect : {0.4, 1.0, 2.5}) {
            const CameraParameters parameters = frame(box, from, {0, 1, 0}, aspect);
            const auto height = 1000;
            const auto width = static_cast<int>(aspect * height);
            const Camera camera(parameters, width, height);
            const Vec3d forward = normalize(parameters.target - parameters.eye);
            const Vec3d right = normalize(cross(forward, parameters.up));
            double most = 0.0;
            for (int c = 0; c < 8; ++c) {
                const Vec3d p{(c & 1) != 0 ? box.hi.x : box.lo.x,
                              (c & 2) != 0 ? box.hi.y : box.lo.y,
                              (c & 4) != 0 ? box.hi.z : box.lo.z};
                const double deep = dot(p - parameters.eye, forward);
                ASSERT_GT(deep, 0.0);
                const double tall = std::tan(0.5 * parameters.view_angle) * deep;
                most = std::max({most, std::fabs(dot(p - parameters.eye, right)) / tall / aspect,
                                 std::fabs(dot(p - parameters.eye, cross(right, forward))) / tall});
            }
            EXPECT_LT(most, 1.0);
            EXPECT_GT(most, 0.9);
        }
    }
}

} // namespace
} // namespace heddle
