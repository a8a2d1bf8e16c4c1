#include <heddle/base/error.h>
#include <heddle/yarn/fiber_table.h>
#include <heddle/yarn/slice_image.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

namespace heddle {
namespace {

YarnType three_plies() {
    YarnType yarn;
    yarn.name = "test";
    yarn.model = YarnModel::Procedural;
    yarn.model_radius = 2.0f;
    yarn.fiber_radius = 0.04f;
    yarn.plies = 3;
    yarn.fibers_per_ply = 40;
    yarn.ply_offset = 0.9f;
    yarn.ellipse_long = 0.7f;
    yarn.ellipse_short = 0.6f;
    yarn.ply_pitch = 10.0f;
    yarn.ply_clockwise = true;
    return yarn;
}

double mean_alpha(const Texture& image) {
    double sum = 0.0;
    for (std::size_t i = 3; i < image.texels.size(); i += 4) sum += image.texels[i];
    return sum / 255.0 / (static_cast<double>(image.texels.size()) / 4.0);
}

/// Mean opacity of all rows and columns: of rays that pass the section from side to side.
double side_opacity(const Texture& image) {
    double sum = 0.0;
    for (int axis = 0; axis < 2; ++axis) {
        const std::int32_t lines = axis == 0 ? image.height : image.width;
        const std::int32_t along = axis == 0 ? image.width : image.height;
        for (std::int32_t i = 0; i < lines; ++i) {
            double clear = 1.0;
            for (std::int32_t j = 0; j < along; ++j) {
                const std::int32_t at = axis == 0 ? i * image.width + j : j * image.width + i;
                clear *= 1.0 - image.texels[static_cast<std::size_t>(4 * at + 3)] / 255.0;
            }
            sum += (1.0 - clear) / lines / 2.0;
        }
    }
    return sum;
}

TEST(SliceImage, AlphaIsTheFibersSectionWhereTheyDoNotOverlap) {
    YarnType yarn = three_plies();
    yarn.plies = 4; // one fiber each, far apart
    yarn.fibers_per_ply = 1;
    yarn.ply_offset = 1.2f;
    yarn.ellipse_long = yarn.ellipse_short = 0.01f;
    yarn.fiber_radius = 0.3f;
    const SliceImage made = make_slice(yarn, {.size = 128});
    const double area = 4 * 3.14159265 * 0.3 * 0.3 / 16.0;
    EXPECT_NEAR(mean_alpha(made.yarn.slice), area, 0.01 * area);
    EXPECT_EQ(made.outside, 0.0);
}

TEST(SliceImage, TheSliceHasTheYarnsTwistSizeAndFibers) {
    const SliceImage made = make_slice(three_plies(), {.size = 64});
    EXPECT_EQ(made.yarn.model, YarnModel::Slice);
    EXPECT_EQ(made.yarn.slice.width, 64);
    EXPECT_EQ(made.yarn.slice.channels, 4);
    EXPECT_NEAR(made.yarn.twist, -0.62831853f, 1e-6f);
    EXPECT_EQ(made.yarn.slice_fibers, 120);
    ASSERT_EQ(made.notes.size(), 1u);
    EXPECT_NE(made.notes[0].find("turns of fibers about their ply"), std::string::npos);
    // place_fibers() chooses the radius so that the sections of its fibers sum to alpha
    const FiberTable table = place_fibers(made.yarn, 0, 0);
    const double filled = 120 * 3.14159265 * std::pow(static_cast<double>(table.fiber_radius), 2);
    EXPECT_NEAR(filled, mean_alpha(made.yarn.slice) * 16.0, 1e-3);
}

TEST(SliceImage, TheSliceHasNoneOfWhatItsNotesSayIsLost) {
    YarnType yarn;
    yarn.model = YarnModel::Procedural;
    yarn.fiber_radius = 0.05f;
    yarn.flyaways = true;
    yarn.hair_density = 10.0f;
    yarn.migration = true;
    const SliceImage slice = make_slice(yarn, {.size = 16});
    ASSERT_FALSE(slice.notes.empty());
    EXPECT_NE(slice.notes[0].find("without migration, flyaways"), std::string::npos);
    EXPECT_FALSE(slice.yarn.flyaways); // else fibers would grow hairs that no picture shows
    EXPECT_FALSE(slice.yarn.migration);
}

TEST(SliceImage, SaysWhatLiesOutsideItsSquare) {
    YarnType yarn = three_plies();
    yarn.ply_offset = 2.0f;
    EXPECT_GT(make_slice(yarn).outside, 0.1);
    EXPECT_NE(make_slice(yarn).notes.back().find("outside the slice's square"), std::string::npos);
    EXPECT_EQ(make_slice(three_plies()).outside, 0.0);
}

TEST(SliceImage, OtherYarnsAndSizesAreRefused) {
    YarnType solid;
    EXPECT_THROW((void)make_slice(solid), Error);
    EXPECT_THROW((void)make_slice(three_plies(), {.size = 0}), Error);
    EXPECT_THROW((void)make_slice(three_plies(), {.size = 4097}), Error);
    EXPECT_THROW((void)bake_occlusion(three_plies()), Error);
}

TEST(Occlusion, AnEmptySliceIsLitAndAFullOneIsDarkInTheMiddle) {
    YarnType yarn = make_slice(three_plies(), {.size = 33}).yarn;
    for (std::size_t i = 3; i < yarn.slice.texels.size(); i += 4) yarn.slice.texels[i] = 0;
    EXPECT_EQ(bake_occlusion(yarn).texels[33 * 16 + 16], 255);
    for (std::size_t i = 3; i < yarn.slice.texels.size(); i += 4) yarn.slice.texels[i] = 255;
    const Texture full = bake_occlusion(yarn);
    EXPECT_EQ(full.texels[33 * 16 + 16], 0);
    EXPECT_GT(full.texels[0], 0); // a corner sees out over three quarters of the directions
}

TEST(Occlusion, FallsOffByFibersProjectedArea) {
    YarnType yarn = make_slice(three_plies(), {.size = 101}).yarn;
    yarn.fiber_radius = 10.0f;
    for (std::size_t i = 3; i < yarn.slice.texels.size(); i += 4) yarn.slice.texels[i] = 255;
    // from the middle to the side, 2 to 2.83 units of extinction 2 / (pi 10)
    const double light = bake_occlusion(yarn).texels[101 * 50 + 50] / 255.0;
    EXPECT_LT(light, std::exp(-2.0 * 0.0636619772));
    EXPECT_GT(light, std::exp(-2.83 * 0.0636619772));
}

TEST(ShrinkSlice, KeepsOpacityFromTheSideWhereMeanAlphaGrowsClear) {
    const Texture image = make_slice(three_plies(), {.size = 128}).yarn.slice;
    const std::vector<Texture> levels = shrink_slice(image);
    ASSERT_EQ(levels.size(), 8u);
    const double whole = side_opacity(image);
    for (std::size_t l = 1; l < 5; ++l) {
        EXPECT_NEAR(side_opacity(levels[l]), whole, 0.12) << l;
        EXPECT_GT(mean_alpha(levels[l]), 1.2 * mean_alpha(image)) << l;
    }
    EXPECT_EQ(levels.back().width, 1);
}

TEST(ShrinkSlice, FullStaysFullAndClearStaysClearAtOddSizes) {
    Texture image;
    image.width = 5;
    image.height = 3;
    image.channels = 4;
    image.texels.assign(60, 255);
    for (const Texture& level : shrink_slice(image)) EXPECT_EQ(mean_alpha(level), 1.0);
    image.texels.assign(60, 0);
    for (const Texture& level : shrink_slice(image)) EXPECT_EQ(mean_alpha(level), 0.0);
}

} // namespace
} // namespace heddle
