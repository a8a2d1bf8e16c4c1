#include <heddle/viewer/session/yarn_edit.h>

#include <heddle/viewer/orbit.h>
#include <heddle/voxelize/test_voxelize.h>

#include <gtest/gtest.h>

namespace heddle::viewer {
namespace {

/// A yarn along x at z = 0 and a plain fiber along x at z = 5.
Geometry two_kinds() {
    CurveSet yarn;
    heddle::test::add_curve(yarn, {{-2, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {2, 0, 0}});
    yarn.default_radius = 0.1f;
    Geometry out = heddle::test::geometry_of(yarn);
    CurveSet fiber;
    heddle::test::add_curve(fiber, {{-2, 0, 5}, {-1, 0, 5}, {1, 0, 5}, {2, 0, 5}});
    fiber.radius = {0.1f, 0.2f, 0.2f, 0.1f};
    out.curves.push_back(fiber);
    out.yarns.emplace_back();
    out.yarns[0].name = "cotton";
    out.yarns[0].radius = 0.3f;
    out.yarns[0].twist = 1.0f;
    out.curves[0].yarn = 0;
    return out;
}

TEST(YarnEdit, ChangesItsKindAlone) {
    const Geometry from = two_kinds();
    EXPECT_EQ(names_of_kinds(from), (std::vector<std::string>{"cotton", "fibers"}));
    const Geometry yarn = edited(from, {{.radius = 2.0, .twist = 0.5}, {}});
    EXPECT_FLOAT_EQ(yarn.yarns[0].radius, 0.6f);
    EXPECT_FLOAT_EQ(yarn.yarns[0].twist, 1.5f);
    EXPECT_EQ(yarn.curves[1].radius, from.curves[1].radius);
    const Geometry fiber = edited(from, {{}, {.radius = 3.0}});
    EXPECT_FLOAT_EQ(fiber.curves[1].radius[1], 0.6f);
    EXPECT_FLOAT_EQ(fiber.yarns[0].radius, 0.3f);
}

TEST(YarnEdit, TintsOverTheMaterialsColour) {
    Geometry from = two_kinds();
    from.materials[0].albedo = {0.5f, 1.0f, 1.0f};
    const YarnEdit red{.tint = {1.0f, 0.5f, 0.0f}};
    const Geometry to = edited(from, {red, {}});
    ASSERT_EQ(to.curves[0].color.size(), 4u);
    EXPECT_EQ(to.curves[0].color[0], 0x008080u);
    EXPECT_TRUE(to.curves[1].color.empty());
    EXPECT_TRUE(edited(from, {{}, {}}).curves[0].color.empty());
}

TEST(YarnEdit, DensityIsAsManyFibersMore) {
    Geometry geometry = two_kinds();
    geometry.yarns[0].slice_fibers = 90;
    multiply_fibers(geometry, 1.5);
    EXPECT_EQ(geometry.yarns[0].slice_fibers, 135);
    multiply_fibers(geometry, 1e-9);
    EXPECT_EQ(geometry.yarns[0].slice_fibers, 1);
}

TEST(YarnEdit, SeenBoundsHoldWhatTheCameraSees) {
    const Geometry from = two_kinds();
    Orbit orbit{.from = {0.0, 0.0, 1.0}, .height = 3.0}; // y and, at aspect 1, x in [-1.5, 1.5]
    const Bounds box = seen_bounds(from, orbit.camera(), 1.0);
    EXPECT_NEAR(box.lo.x, -1.3, 1e-6);
    EXPECT_NEAR(box.hi.x, 1.3, 1e-6);
    EXPECT_NEAR(box.hi.z, 5.2, 1e-6);
    EXPECT_NEAR(seen_bounds(from, orbit.camera(), 2.0).hi.x, 2.3, 1e-6);
    orbit.target = {0.0, 20.0, 0.0};
    EXPECT_TRUE(seen_bounds(from, orbit.camera(), 1.0).empty());
    orbit = {.from = {0.0, 0.0, 1.0}, .height = 3.0, .view_angle = 0.5}; // the eye is at z = 5.9
    EXPECT_NEAR(seen_bounds(from, orbit.camera(), 1.0).hi.z, 0.3, 1e-6)
        << "x = 1 at z = 5 is outside";
}

} // namespace
} // namespace heddle::viewer
