#include <heddle/viewer/slice/slice_renderer.h>

#include <heddle/base/error.h>
#include <heddle/geom/generate.h>
#include <heddle/viewer/volume/voxel_renderer.h>
#include <heddle/voxelize/test_voxelize.h>
#include <heddle/yarn/slice_image.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace heddle::viewer {
namespace {

constexpr std::int32_t kSize = 96;

/// Two plain fibers, red along x at z = `red`, blue along y at z = 0.
Geometry cross_at(float red) {
    CurveSet set;
    heddle::test::add_curve(set,
                            {{-1.5f, 0, red}, {-0.5f, 0, red}, {0.5f, 0, red}, {1.5f, 0, red}});
    heddle::test::add_curve(set, {{0, -1.5f, 0}, {0, -0.5f, 0}, {0, 0.5f, 0}, {0, 1.5f, 0}});
    set.default_radius = 0.1f;
    set.color = {0xff, 0xff, 0xff, 0xff, 0xff0000, 0xff0000, 0xff0000, 0xff0000};
    return heddle::test::geometry_of(set);
}

SliceLook look_of(bool sorted, bool shadows, Vec3d light = {0.0, 0.0, 1.0}) {
    return {.light = light, .sorted = sorted, .shadows = shadows};
}

/// All of it from a side; rays are parallel if `view_angle` is 0.
RgbImage
picture(SliceRenderer& renderer, Vec3d from, const SliceLook& look, double view_angle = 0.0) {
    Orbit orbit{.from = from, .view_angle = view_angle};
    orbit.frame(renderer.ball(), 1.0);
    const RenderTarget target(kSize, kSize);
    target.clear();
    renderer.draw(target, orbit.camera(), look);
    return target.image();
}

constexpr Vec3d kFront{0.0, 0.0, 1.0};
constexpr Vec3d kBack{0.0, 0.0, -1.0};

using Rgb = std::array<int, 3>;

Rgb pixel(const RgbImage& image, std::int32_t x, std::int32_t y) {
    const std::uint8_t* p = &image.rgb[3 * static_cast<std::size_t>(y * image.width + x)];
    return {p[0], p[1], p[2]};
}

bool is_red(Rgb p) {
    return p[0] > p[2] + 60;
}
bool is_blue(Rgb p) {
    return p[2] > p[0] + 60;
}
TEST(SliceView, TheNearerYarnIsInFrontFromBothSidesOnlyWhenSorted) {
    const opengl::Context context;
    for (const double angle : {0.0, 0.6}) {
        SliceRenderer renderer(context, cross_at(0.3f), {});
        SliceRenderer behind(context, cross_at(-0.3f), {});
        for (const bool sorted : {true, false}) {
            const SliceLook look = look_of(sorted, false);
            const Rgb front = pixel(picture(renderer, kFront, look, angle), kSize / 2, kSize / 2);
            const Rgb back = pixel(picture(renderer, kBack, look, angle), kSize / 2, kSize / 2);
            EXPECT_TRUE(sorted ? is_red(front) : is_blue(front)) << sorted; // blue was placed last
            EXPECT_TRUE(is_blue(back)) << sorted;
        }
        const SliceLook look = look_of(true, false);
        EXPECT_TRUE(is_blue(pixel(picture(behind, kFront, look, angle), kSize / 2, kSize / 2)));
        EXPECT_TRUE(is_red(pixel(picture(behind, kBack, look, angle), kSize / 2, kSize / 2)));
    }
}

TEST(SliceView, WeightsShowTheNearerYarnWithoutAnOrderAndOverManyChunks) {
    const opengl::Context context;
    SliceRenderer whole(context, cross_at(0.3f), {});
    // one yarn a chunk: 64 bytes of each slice and 81 of it in view
    SliceRenderer split(context, cross_at(0.3f),
                        {.memory_bytes = whole.slice_count() * 145 * 6 / 10});
    EXPECT_FALSE(whole.is_split());
    ASSERT_TRUE(split.is_split());
    EXPECT_EQ(split.slice_count(), whole.slice_count());
    SliceLook look = look_of(true, true);
    look.weighted = true;
    for (const Vec3d from : {kFront, kBack}) {
        const RgbImage a = picture(whole, from, look);
        const RgbImage b = picture(split, from, look);
        EXPECT_EQ(a.rgb, picture(whole, from, look).rgb);
        int far = 0;
        for (std::size_t i = 0; i < a.rgb.size(); ++i)
            far += std::abs(a.rgb[i] - b.rgb[i]) > 1 ? 1 : 0;
        EXPECT_EQ(far, 0);
        const Rgb middle = pixel(b, kSize / 2, kSize / 2);
        EXPECT_TRUE(from.z > 0.0 ? is_red(middle) : is_blue(middle));
    }
}

TEST(SliceView, IsWhiteBesideTheYarnsAndHasTheirWidth) {
    const opengl::Context context;
    SliceRenderer renderer(context, cross_at(0.3f), {});
    const RgbImage image = picture(renderer, kFront, look_of(true, true));
    EXPECT_EQ(pixel(image, 2, 2), (Rgb{255, 255, 255}));
    int covered = 0; // pixels of a column that only the red one crosses
    for (std::int32_t y = 0; y < kSize; ++y) {
        covered += pixel(image, kSize / 2 + 6, y)[2] < 200 ? 1 : 0;
    }
    EXPECT_NEAR(covered, 0.2 * kSize / (2.0 * renderer.ball().radius), 2.0);
    EXPECT_EQ(picture(renderer, kFront, look_of(true, true)).rgb, image.rgb);
}

TEST(SliceView, AFarEyeSeesWhatParallelRaysSee) {
    const opengl::Context context;
    SliceRenderer renderer(context, cross_at(0.3f), {});
    constexpr Vec3d kAside{1.0, 0.4, 0.5};
    const RgbImage near = picture(renderer, kAside, look_of(true, true), 2.5);
    const RgbImage far = picture(renderer, kAside, look_of(true, true), 0.002);
    const RgbImage parallel = picture(renderer, kAside, look_of(true, true));
    const auto apart = [&](const RgbImage& a) {
        int count = 0;
        for (std::size_t i = 0; i < a.rgb.size(); ++i) {
            count += std::abs(a.rgb[i] - parallel.rgb[i]) > 6 ? 1 : 0;
        }
        return count;
    };
    EXPECT_LT(apart(far), static_cast<int>(far.rgb.size() / 200));
    EXPECT_GT(apart(near), static_cast<int>(far.rgb.size() / 100)) << "this test tells them apart";
}

TEST(SliceView, TheEyeMayStandInAYarnOrPastIt) {
    const opengl::Context context;
    SliceRenderer renderer(context, cross_at(0.3f), {});
    const RenderTarget target(kSize, kSize);
    for (const double z : {0.3, 0.35, 0.0}) {
        CameraParameters camera{
            .eye = {-0.4, 0.0, z}, .target = {1.0, 0.0, z}, .up = {0.0, 0.0, 1.0}};
        camera.view_angle = 1.0;
        target.clear();
        EXPECT_NO_THROW(renderer.draw(target, camera, look_of(true, true)));
        const RgbImage image = target.image();
        if (z == 0.3) {
            EXPECT_NE(pixel(image, 5, 5), (Rgb{255, 255, 255})) << "inside of the red one";
        }
    }
    target.clear(); // all is behind the eye
    renderer.draw(target, {.eye = {0.0, 0.0, 5.0}, .target = {0.0, 0.0, 9.0}}, look_of(true, true));
    for (const std::uint8_t c : target.image().rgb) ASSERT_EQ(c, 255);
}

TEST(SliceView, BandsMakeTheSamePictureAsOneDraw) {
    const opengl::Context context;
    SliceRenderer renderer(context, cross_at(0.3f), {});
    SliceLook look = look_of(true, true);
    for (const bool weighted : {false, true}) {
        look.weighted = weighted;
        const RgbImage whole = picture(renderer, kFront, look);
        Orbit orbit{.from = kFront};
        orbit.frame(renderer.ball(), 1.0);
        const RenderTarget target(kSize, kSize);
        target.clear();
        for (std::int32_t y = 0; y < kSize; y += 24) {
            target.limit(y, y + 24);
            renderer.draw(target, orbit.camera(), look);
        }
        target.limit(0, kSize);
        EXPECT_EQ(target.image().rgb, whole.rgb);
    }
}

TEST(SliceView, PlacedAgainItShowsTheNewYarns) {
    const opengl::Context context;
    SliceRenderer renderer(context, cross_at(0.3f), {});
    SliceRenderer other(context, cross_at(-0.3f), {});
    renderer.place(cross_at(-0.3f));
    const SliceLook look = look_of(true, true);
    EXPECT_EQ(picture(renderer, kFront, look).rgb, picture(other, kFront, look).rgb);
}

TEST(SliceView, ShadowsDarkenWhatLiesBehindAnotherYarnSeenFromTheLight) {
    const opengl::Context context;
    SliceRenderer renderer(context, cross_at(0.3f), {});
    const Vec3d light{0.0, 1.0, 1.0};
    const RgbImage a = picture(renderer, kFront, look_of(true, false, light));
    const RgbImage b = picture(renderer, kFront, look_of(true, true, light));
    int darker = 0;
    int brighter = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        darker += b.rgb[i] + 8 < a.rgb[i] ? 1 : 0;
        brighter += b.rgb[i] > a.rgb[i] + 8 ? 1 : 0;
    }
    EXPECT_GT(darker, 5);
    EXPECT_EQ(brighter, 0);
    // the light is above: the red yarn's shadow is on the blue one below the crossing
    const double scale = kSize / (2.0 * renderer.ball().radius);
    const auto row = static_cast<std::int32_t>(kSize / 2.0 + 0.2 * scale);
    EXPECT_LT(pixel(b, kSize / 2, row)[2], pixel(a, kSize / 2, row)[2] - 8);
}

TEST(SliceView, OcclusionDarkensASlicesInside) {
    YarnType yarn;
    yarn.model = YarnModel::Procedural;
    yarn.fiber_radius = 0.1f;
    yarn.fibers_per_ply = 60;
    yarn.radius = 0.4f;
    Geometry geometry = cross_at(0.3f);
    geometry.yarns.push_back(make_slice(yarn, {.size = 64}).yarn);
    geometry.curves[0].yarn = 0;
    const opengl::Context context;
    SliceRenderer renderer(context, geometry, {});
    SliceLook look = look_of(true, false);
    const RgbImage with = picture(renderer, kFront, look);
    look.occlusion = false;
    const RgbImage without = picture(renderer, kFront, look);
    double sums[2]{};
    for (std::size_t i = 0; i < with.rgb.size(); ++i) {
        sums[0] += with.rgb[i];
        sums[1] += without.rgb[i];
    }
    EXPECT_LT(sums[0], sums[1]);
}

TEST(SliceView, DirectionsAreThoseOfTheYarnsInTheWorld) {
    const opengl::Context context;
    SliceRenderer renderer(context, cross_at(0.3f), {});
    SliceLook look = look_of(true, false);
    look.color = SliceColor::Direction;
    const RgbImage image = picture(renderer, {0.2, 0.1, 1.0}, look);
    const Rgb along_x = pixel(image, kSize / 2 + 8, kSize / 2 - 1);
    EXPECT_GT(along_x[0], 250);
    EXPECT_LT(along_x[1], 40);
}

TEST(SliceView, GridShowsTheDirectionThatVoxelsStoreAndGreyWhereThereIsNone) {
    const opengl::Context context;
    const Geometry geometry = cross_at(0.3f);
    SliceRenderer renderer(context, geometry, {});
    VoxelizeOptions options;
    options.voxel_size = {0.05, 0.05, 0.05};
    options.bounds = Bounds{{-2.0, -2.0, -2.0}, {0.0, 2.0, 2.0}}; // half of the red yarn
    const VoxelizePlan plan = plan_voxelize(geometry, options);
    Progress silent;
    const std::unique_ptr<VoxelLevel> grid = voxelize(geometry, options, plan, silent);
    const VoxelLevel* const levels[] = {grid.get()};
    const VoxelRenderer voxels(context, levels, {}, silent);
    SliceLook look = look_of(true, false);
    look.color = SliceColor::Grid;
    const auto draw = [&](const SliceLook& how) {
        Orbit orbit{.from = kFront};
        orbit.frame(renderer.ball(), 1.0);
        const RenderTarget target(kSize, kSize);
        target.clear();
        renderer.draw(target, orbit.camera(), how, &voxels);
        return target.image();
    };
    for (const bool weighted : {false, true}) {
        look.weighted = weighted;
        const RgbImage image = draw(look);
        const Rgb stored = pixel(image, kSize / 2 - 8, kSize / 2);
        EXPECT_GT(stored[0], 245) << "along x";
        EXPECT_LT(stored[1], 90);
        const Rgb none = pixel(image, kSize / 2 + 8, kSize / 2);
        EXPECT_EQ(none[0], none[1]);
        EXPECT_EQ(none[1], none[2]);
    }
    look.white_block = Vec3i{-1, 0, 0}; // of 1.6: x and y of the yarn's upper half
    EXPECT_EQ(pixel(draw(look), kSize / 2 - 8, kSize / 2 - 1), (Rgb{255, 255, 255}));
    EXPECT_THROW((void)picture(renderer, kFront, look), Error) << "no voxels";
}

TEST(SliceView, WhatCannotBeShownIsOneLine) {
    const opengl::Context context;
    const auto code = [](auto&& run) {
        try {
            run();
        } catch (const Error& e) {
            return e.code();
        }
        return ErrorCode::Internal;
    };
    const auto grass = generate({.kind = GenerateKind::Grass, .nx = 2, .ny = 2});
    EXPECT_EQ(code([&] { SliceRenderer(context, grass, {}); }), ErrorCode::Unsupported);
    EXPECT_EQ(code([&] { SliceRenderer(context, {}, {}); }), ErrorCode::Unsupported);
    EXPECT_EQ(code([] { RenderTarget(0, 5); }), ErrorCode::InvalidArgument);
    EXPECT_EQ(code([] { RenderTarget(9000, 5); }), ErrorCode::InvalidArgument);
    SliceRenderer renderer(context, cross_at(0.3f), {});
    const auto draw = [&](Vec3d from, const SliceLook& look) {
        return code([&] { (void)picture(renderer, from, look); });
    };
    EXPECT_EQ(draw({}, {}), ErrorCode::InvalidArgument);
    EXPECT_EQ(draw(kFront, {.light = {}}), ErrorCode::InvalidArgument);
    EXPECT_EQ(draw(kFront, {.opacity = 0.0}), ErrorCode::InvalidArgument);
    EXPECT_EQ(draw(kFront, {.map_size = 4}), ErrorCode::InvalidArgument);
    EXPECT_NO_THROW((void)picture(renderer, {0.0, 1.0, 0.0}, {})); // along `up`
}

TEST(SliceView, ATwistThatNoPixelShowsIsManySlicesNotAnError) {
    YarnType yarn;
    yarn.model = YarnModel::Procedural;
    yarn.radius = 0.1f;
    Geometry geometry = cross_at(0.3f);
    geometry.yarns.push_back(make_slice(yarn, {.size = 32}).yarn);
    geometry.curves[0].yarn = 0;
    const opengl::Context context;
    geometry.yarns[0].twist = 1e9f;
    EXPECT_THROW(SliceRenderer(context, geometry, {}), Error);
    geometry.yarns[0].twist = 60.0f;
    EXPECT_GT(SliceRenderer(context, geometry, {}).slice_count(), 1000);
}

} // namespace
} // namespace heddle::viewer
