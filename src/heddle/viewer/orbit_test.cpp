#include <heddle/viewer/orbit.h>

#include <heddle/base/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace heddle::viewer {
namespace {

constexpr Ball kBall{{1.0, 2.0, 3.0}, 2.0};

TEST(Orbit, AFramedBallTouchesThePicturesEdges) {
    for (const double angle : {0.0, 0.6, 2.0}) {
        for (const double aspect : {1.0, 2.0, 0.5}) {
            Orbit orbit{.view_angle = angle};
            orbit.frame(kBall, aspect);
            const CameraParameters camera = orbit.camera();
            const double half = std::min(1.0, aspect);
            if (angle == 0.0) {
                EXPECT_NEAR(camera.view_height * half, 2.0 * kBall.radius, 1e-12);
                continue;
            }
            const double away = length(camera.eye - camera.target);
            const double seen =
                std::tan(std::asin(kBall.radius / away)); // radius of the ball, at distance 1
            EXPECT_LE(seen, half * std::tan(0.5 * angle) + 1e-12) << angle << " " << aspect;
            if (aspect >= 1.0) {
                EXPECT_NEAR(seen, std::tan(0.5 * angle), 1e-12);
            }
        }
    }
}

TEST(Orbit, GoesAroundAndBackAndNeverOverThePole) {
    Orbit orbit{.from = {0.0, 0.0, 1.0}};
    orbit.turn(0.5 * std::numbers::pi, 0.0);
    EXPECT_NEAR(orbit.from.x, -1.0, 1e-12); // the left side comes to the front
    orbit.turn(0.0, 0.3);
    EXPECT_NEAR(std::asin(orbit.from.y), 0.3, 1e-12);
    orbit.turn(0.0, 40.0);
    EXPECT_LT(orbit.from.y, 1.0);
    EXPECT_LT(orbit.from.x, 0.0);
    orbit.turn(0.0, -80.0);
    EXPECT_LT(orbit.from.x, 0.0);
    EXPECT_NEAR(length(orbit.from), 1.0, 1e-9);
}

TEST(Orbit, PansWithThePictureAndZooms) {
    Orbit orbit{.from = {0.0, 0.0, 1.0}, .height = 4.0};
    orbit.pan(0.25, -0.5); // the object moves right and down
    EXPECT_NEAR(orbit.target.x, -1.0, 1e-12);
    EXPECT_NEAR(orbit.target.y, 2.0, 1e-12);
    orbit.zoom(2.0);
    EXPECT_EQ(orbit.camera().view_height, 2.0);
    orbit.view_angle = 0.5;
    EXPECT_NEAR(length(orbit.camera().eye - orbit.target), 1.0 / std::tan(0.25), 1e-12);
}

TEST(Orbit, SeesAlongUpAndRefusesWhatHasNoDirection) {
    const Orbit above{.from = {0.0, 2.0, 0.0}};
    EXPECT_NEAR(dot(above.camera().up, above.from), 0.0, 1e-12);
    EXPECT_NEAR(length(above.camera().up), 1.0, 1e-12);
    EXPECT_THROW((void)Orbit{.from = {}}.camera(), Error);
    EXPECT_THROW((void)Orbit{.up = {}}.camera(), Error);
    EXPECT_THROW((void)Orbit{.height = 0.0}.camera(), Error);
    EXPECT_THROW((void)Orbit{.view_angle = 3.2}.camera(), Error);
}

} // namespace
} // namespace heddle::viewer
