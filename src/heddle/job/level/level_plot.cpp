#include <heddle/job/level/level_plot.h>

#include <array>
#include <utility>

namespace heddle::job {
namespace {

/// Returns a colour that colour-blind people can tell apart too [Okabe and Ito 2008], and a wide
/// grey line, on which others remain visible, for the file's own levels.
PlotLine line_of(const std::string& name) {
    static const std::vector<std::pair<std::string, std::string>> colors{
        {"moments", "#0072b2"}, {"wasserstein", "#e69f00"}, {"single", "#d55e00"},
        {"naive", "#009e73"},   {"random", "#cc79a7"},      {"interpolate", "#56b4e9"}};
    for (const auto& [of, color] : colors) {
        if (of == name) return {.name = name, .y = {}, .color = color};
    }
    return {.name = name, .y = {}, .color = "#bebebe", .width = 7.0};
}

} // namespace

std::vector<PlotPanel> panels_of(const LevelTable& table) {
    std::vector<PlotPanel> panels{{"error of projected area, mean", "level", true, {}},
                                  {"L1 distance of densities, mean", "level", true, {}}};
    if (table.coverage != CoverageTruth::None) {
        panels.push_back({"error of coverage, mean", "level", false, {}});
    }
    for (const MethodRow& m : table.methods) {
        std::array<PlotLine, 3> lines{line_of(m.errors.name), line_of(m.errors.name),
                                      line_of(m.errors.name)};
        for (const LevelErrors& e : m.errors.levels) {
            lines[0].y.emplace_back(e.sigma);
            lines[1].y.emplace_back(e.cells);
            lines[2].y.push_back(e.coverage);
        }
        for (std::size_t p = 0; p < panels.size(); ++p) panels[p].lines.push_back(lines[p]);
    }
    return panels;
}

std::string plot_levels(const LevelTable& table) {
    return draw_svg(panels_of(table));
}

} // namespace heddle::job
