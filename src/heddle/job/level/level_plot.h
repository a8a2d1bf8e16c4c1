#pragma once

#include <heddle/job/level/measure_levels.h>
#include <heddle/job/level/svg_plot.h>

#include <string>
#include <vector>

namespace heddle::job {

/// Errors of projected area, of densities and, where it is known, of coverage by level.
[[nodiscard]] std::vector<PlotPanel> panels_of(const LevelTable& table);

/// These panels as an SVG.
[[nodiscard]] std::string plot_levels(const LevelTable& table);

} // namespace heddle::job
