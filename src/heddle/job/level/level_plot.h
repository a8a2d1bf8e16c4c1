#pragma once

#include <heddle/job/level/measure_levels.h>
#include <heddle/job/level/svg_plot.h>

#include <string>
#include <vector>

namespace heddle::job {

/// Returns plots, over the levels, of the errors of projected area, of densities and, if known, of
/// coverage.
[[nodiscard]] std::vector<PlotPanel> panels_of(const LevelTable& table);

/// Returns an SVG of panels_of(table).
[[nodiscard]] std::string plot_levels(const LevelTable& table);

} // namespace heddle::job
