#include <heddle/viewer/slice_view.h>

#include <heddle/base/error.h>
#include <heddle/geom/generate.h>
#include <heddle/geom/slice_image.h>
#include <heddle/voxel/test_voxelize.h>

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

ViewOptions options_of(bool sorted, bool shadows) {
    return {.width = kSize, .height = kSize, .sorted = sorted, .shadows = shadows};
}

using Rgb = std::array<int, 3>;

Rgb pixel(const ViewImage& image, std::int32_t x, std::int32_t y) {
    const std::uint8_t* p = &image.rgb[3 * static_cast<std::size_t>(y * image.width + x)];
    return {p[0], p[1], p[2]};
}

bool is_red(Rgb p) {
    return p[0] > p[2] + 60;
}
bool is_blue(Rgb p) {
    return p[2] > p[0] + 60;
}
constexpr ViewPose kFront{.from = {0.0, 0.0, 1.0}, .light = {0.0, 0.0, 1.0}};
constexpr ViewPose kBack{.from = {0.0, 0.0, -1.0}, .light = {0.0, 0.0, 1.0}};

TEST(SliceView, TheNearerYarnIsInFrontFromBothSidesOnlyWhenSorted) {
    const raster::Context context;
    for (const bool sorted : {true, false}) {
        const SliceView view(context, cross_at(0.3f), options_of(sorted, false));
        const Rgb front = pixel(view.draw(kFront), kSize / 2, kSize / 2);
        const Rgb back = pixel(view.draw(kBack), kSize / 2, kSize / 2);
        EXPECT_TRUE(sorted ? is_red(front) : is_blue(front)) << sorted; // blue was placed last
        EXPECT_TRUE(is_blue(back)) << sorted;
    }
    const SliceView behind(context, cross_at(-0.3f), options_of(true, false));
    EXPECT_TRUE(is_blue(pixel(behind.draw(kFront), kSize / 2, kSize / 2)));
    EXPECT_TRUE(is_red(pixel(behind.draw(kBack), kSize / 2, kSize / 2)));
}

TEST(SliceView, IsWhiteBesideTheYarnsAndHasTheirWidth) {
    const raster::Context context;
    const SliceView view(context, cross_at(0.3f), options_of(true, true));
    const ViewImage image = view.draw(kFront);
    EXPECT_EQ(pixel(image, 2, 2), (Rgb{255, 255, 255}));
    int covered = 0; // of a column that the red one alone crosses
    for (std::int32_t y = 0; y < kSize; ++y) {
        covered += pixel(image, kSize / 2 + 6, y)[2] < 200 ? 1 : 0;
    }
    // .2 of a ball of diameter 2 x (half the diagonal of 3 x 3 x .3, and .15)
    const double wide = 0.2 * kSize / (2.0 * (0.5 * std::sqrt(18.09) + 0.15));
    EXPECT_NEAR(covered, wide, 2.0);
    EXPECT_EQ(view.draw(kFront).rgb, image.rgb);
}

TEST(SliceView, ShadowsDarkenWhatLiesBehindAnotherYarnSeenFromTheLight) {
    const raster::Context context;
    const ViewPose side{.from = {0.0, 0.0, 1.0}, .light = {0.0, 1.0, 1.0}};
    const SliceView lit(context, cross_at(0.3f), options_of(true, false));
    const SliceView shaded(context, cross_at(0.3f), options_of(true, true));
    const ViewImage a = lit.draw(side);
    const ViewImage b = shaded.draw(side);
    int darker = 0;
    int brighter = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        darker += b.rgb[i] + 8 < a.rgb[i] ? 1 : 0;
        brighter += b.rgb[i] > a.rgb[i] + 8 ? 1 : 0;
    }
    EXPECT_GT(darker, 5);
    EXPECT_EQ(brighter, 0);
    // the light comes from above: the red yarn's shadow falls on the blue one below the crossing
    const double scale = kSize / (2.0 * (0.5 * std::sqrt(18.09) + 0.15));
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
    const raster::Context context;
    ViewOptions options = options_of(true, false);
    const ViewImage with = SliceView(context, geometry, options).draw(kFront);
    options.occlusion = false;
    const ViewImage without = SliceView(context, geometry, options).draw(kFront);
    double sums[2]{};
    for (std::size_t i = 0; i < with.rgb.size(); ++i) {
        sums[0] += with.rgb[i];
        sums[1] += without.rgb[i];
    }
    EXPECT_LT(sums[0], sums[1]);
}

TEST(SliceView, WhatCannotBeShownIsOneLine) {
    const raster::Context context;
    const auto code = [&](Geometry geometry, ViewOptions options) {
        try {
            const SliceView view(context, std::move(geometry), options);
        } catch (const Error& e) {
            return e.code();
        }
        return ErrorCode::Internal;
    };
    EXPECT_EQ(code(generate({.kind = GenerateKind::Grass, .nx = 2, .ny = 2}), {}),
              ErrorCode::Unsupported);
    EXPECT_EQ(code({}, {}), ErrorCode::Unsupported);
    EXPECT_EQ(code(cross_at(0.3f), {.width = 0}), ErrorCode::InvalidArgument);
    EXPECT_EQ(code(cross_at(0.3f), {.width = 9000}), ErrorCode::InvalidArgument);
    const SliceView view(context, cross_at(0.3f), options_of(true, true));
    EXPECT_THROW((void)view.draw({.from = {}}), Error);
    EXPECT_NO_THROW((void)view.draw({.from = {0.0, 1.0, 0.0}})); // along `up`
}

} // namespace
} // namespace heddle::viewer
