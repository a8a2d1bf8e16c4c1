#pragma once

#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// One line of a plot: a value >= 0 at x = 1, 2, 3 ...; a missing value is a gap.
struct PlotLine {
    std::string name{};
    std::vector<std::optional<double>> y{};
    std::string color{}; ///< in SVG notation: "#0072b2"
    double width = 2.0;  ///< px
};

/// Lines over the same x. y starts at 0; if logarithmic, at a label below the smallest value > 0.
struct PlotPanel {
    std::string title{};
    std::string x_label{};
    bool logarithmic = false; ///< the scale of y; 0 is drawn at the bottom
    std::vector<PlotLine> lines{};
};

/// Returns an SVG of the panels side by side on white, with one legend below them.
/// @param panels  at least one, all with lines of the same names
[[nodiscard]] std::string draw_svg(const std::vector<PlotPanel>& panels);

} // namespace heddle::job
