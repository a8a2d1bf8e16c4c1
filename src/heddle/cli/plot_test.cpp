#include <heddle/cli/font.h>
#include <heddle/cli/plot.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace heddle::cli {
namespace {

std::int64_t pixels_of(const PlotImage& image, std::array<std::uint8_t, 3> color) {
    std::int64_t count = 0;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
        count += std::equal(color.begin(), color.end(), image.rgb.begin() + static_cast<long>(i));
    }
    return count;
}

TEST(Plot, DrawsEveryLineInItsColourAndPanelsSideBySide) {
    const PlotPanel panel{"error",
                          "level",
                          false,
                          {{"a", {0.1, 0.2, std::nullopt, 0.3}, {255, 0, 0}},
                           {"b", {0.0, 0.0, 0.0, 0.0}, {0, 0, 255}}}};
    const PlotImage one = draw_plot({panel});
    const PlotImage two = draw_plot({panel, panel});
    EXPECT_EQ(two.width, 2 * one.width);
    EXPECT_EQ(two.height, one.height);
    EXPECT_EQ(one.rgb.size(), static_cast<std::size_t>(one.width * one.height) * 3);
    EXPECT_GT(pixels_of(one, {255, 0, 0}), 300);
    EXPECT_GT(pixels_of(one, {0, 0, 255}), 800);
}

TEST(Plot, AGapIsNotDrawnAndNothingIsNoLine) {
    const auto reds = [](std::vector<std::optional<double>> y) {
        return pixels_of(draw_plot({{"t", "x", false, {{"a", std::move(y), {255, 0, 0}}}}}),
                         {255, 0, 0});
    };
    EXPECT_LT(reds({0.1, std::nullopt, 0.1}), reds({0.1, 0.1, 0.1}));
    EXPECT_GT(reds({0.5}), 0);
    EXPECT_GT(reds({}), 0); // its name below
}

TEST(Plot, ALogarithmicPanelTakesEqualRatiosForEqualSteps) {
    const auto row_of = [](double y, bool logarithmic) { // the lowest of the red dot's
        const PlotImage image = draw_plot(
            {{"",
              "",
              logarithmic,
              {{"", {1.0}, {0, 0, 255}}, {"", {0.001}, {0, 255, 0}}, {"", {y}, {255, 0, 0}}}}});
        std::int32_t low = 0;
        for (std::int32_t row = 0; row < 400; ++row) { // the names stand below
            for (std::int32_t x = 0; x < image.width; ++x) {
                const auto at = static_cast<std::size_t>(row * image.width + x) * 3;
                if (image.rgb[at] == 255 && image.rgb[at + 1] == 0) low = row;
            }
        }
        return low;
    };
    EXPECT_NEAR(row_of(0.01, true) - row_of(0.1, true), row_of(0.1, true) - row_of(1.0, true), 2);
    EXPECT_NEAR(row_of(0.4, false) - row_of(0.6, false), row_of(0.6, false) - row_of(0.8, false),
                2);
    EXPECT_GT(row_of(0.0, true), row_of(0.01, true) + 50);
}

TEST(Font, EveryLetterIsThereOnceAndNoTwoLookTheSame) {
    for (std::size_t i = 0; i < kFont.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_NE(kFont[i].letter, kFont[j].letter);
            EXPECT_NE(kFont[i].row, kFont[j].row) << kFont[i].letter << kFont[j].letter;
        }
        for (const std::uint8_t row : kFont[i].row) EXPECT_LT(row, 1 << kFontWidth);
    }
    EXPECT_EQ(glyph_of('A'), glyph_of('a'));
    EXPECT_NE(glyph_of('#'), glyph_of(' '));
}

} // namespace
} // namespace heddle::cli
