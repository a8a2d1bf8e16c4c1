#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heddle::cli {

/// One line of a plot: a value >= 0 at x = 1, 2, 3 ...; where there is none, a gap.
struct PlotLine {
    std::string name; ///< of digits, letters and . , - : ( )
    std::vector<std::optional<double>> y;
    std::array<std::uint8_t, 3> color{}; ///< sRGB
    double width = 3.0;                  ///< px
};

/// Lines over the same x. y starts at 0, or at a label below the least value above 0.
struct PlotPanel {
    std::string title;
    std::string x_label;
    bool logarithmic = false; ///< y; what is 0 stands at the bottom
    std::vector<PlotLine> lines;
};

/// An RGB picture, rows from the top.
struct PlotImage {
    std::int32_t width = 0; ///< px
    std::int32_t height = 0;
    std::vector<std::uint8_t> rgb;
};

/// Draws the panels side by side on white, and under them the lines' names once.
/// @param panels  at least one, all with lines of the same names
[[nodiscard]] PlotImage draw_plot(const std::vector<PlotPanel>& panels);

} // namespace heddle::cli
