#pragma once

#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// One line of a plot: a value >= 0 at x = 1, 2, 3 ...; where there is none, a gap.
struct PlotLine {
    std::string name{};
    std::vector<std::optional<double>> y{};
    std::string color{}; ///< as SVG has it: "#0072b2"
    double width = 2.0;  ///< px
};

/// Lines over the same x. y starts at 0, or at a label below the least value above 0.
struct PlotPanel {
    std::string title{};
    std::string x_label{};
    bool logarithmic = false; ///< y; what is 0 stands at the bottom
    std::vector<PlotLine> lines{};
};

/// An SVG of the panels side by side on white, and under them the lines' names once.
/// @param panels  at least one, all with lines of the same names
[[nodiscard]] std::string draw_svg(const std::vector<PlotPanel>& panels);

} // namespace heddle::job
