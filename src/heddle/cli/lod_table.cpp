#include <heddle/cli/lod_table.h>

#include <heddle/base/error.h>
#include <heddle/cli/terminal/text.h>

#include <algorithm>
#include <utility>

namespace heddle::cli {
namespace {

using Json = nlohmann::ordered_json;

std::int64_t bytes_at(const MethodRow& method, int level) {
    const auto at = static_cast<std::size_t>(level);
    return at < method.bytes.size() ? method.bytes[at] : 0;
}

std::int64_t bytes_above(const MethodRow& method) {
    std::int64_t sum = 0;
    for (std::size_t l = 1; l < method.bytes.size(); ++l) sum += method.bytes[l];
    return sum;
}

double ratio(std::int64_t a, std::int64_t b) {
    return b > 0 ? static_cast<double>(a) / static_cast<double>(b) : 0.0;
}

std::string show_optional(const std::optional<double>& value, int decimals) {
    return value ? show_fixed(*value, decimals) : "-";
}

std::string coverage_words(CoverageTruth truth) {
    switch (truth) {
    case CoverageTruth::Union: return "the union of all finest columns";
    case CoverageTruth::File: return "the file's own levels (no columns are stored)";
    case CoverageTruth::None: return "nothing, because no columns are stored";
    }
    return {};
}

std::string row_of(const std::vector<std::string>& cells) {
    std::string line = "|";
    for (const std::string& cell : cells) line += str(" ", cell, " |");
    return line + "\n";
}

std::string head_of(const std::vector<std::string>& cells) {
    std::string rule = "|";
    for (std::size_t i = 0; i < cells.size(); ++i) rule += "---|";
    return row_of(cells) + rule + "\n";
}

bool any_lost(const LodTable& table) {
    for (const MethodRow& method : table.methods) {
        for (const LevelErrors& e : method.errors.levels) {
            if (e.lost > 0.0) return true;
        }
    }
    return false;
}

std::string head_text(const LodTable& table) {
    const auto count = [](std::int64_t n) { return show_count(static_cast<double>(n)); };
    std::string text = str("# Levels of detail of `", table.file, "`\n\n");
    text += str("Finest level: ", count(table.voxels), " voxels, ",
                show_fixed(ratio(table.lobes, table.voxels), 3), " lobes per voxel");
    if (table.part_of > 0) {
        text += str(", a part of ", count(table.part_of),
                    " voxels (above level 5, children are missing)");
    }
    text += str("; size in the file ", show_bytes(static_cast<double>(table.finest_bytes)));
    if (table.mask_bytes > 0) {
        text +=
            str(" and ", show_bytes(static_cast<double>(table.mask_bytes)), " of columns and sums");
    }
    text += str(". The file's levels were built by `", table.lod, "`. ");
    if (table.approximate)
        text +=
            "The file has no sums: levels are built from the stored lobes (approximate), and the finest lobes are weighted by mean optical depth. "
            "The file's own levels were weighted by sums, so their errors include that difference. ";
    return text + str("Coverage is compared with ", coverage_words(table.coverage), ".\n");
}

std::string method_table(const LodTable& table) {
    std::string text = head_of({"method", "build time, s", "million finest voxels per second",
                                "size above level 0", "times level 0"});
    const std::int64_t finest = table.part_of > 0 ? 0 : table.finest_bytes;
    for (const MethodRow& m : table.methods) {
        const double seconds = m.build_seconds.value_or(0.0);
        const double rate = static_cast<double>(table.voxels) / std::max(1e-9, seconds) * 1e-6;
        text += row_of({m.errors.name, show_optional(m.build_seconds, 2),
                        m.build_seconds ? show_fixed(rate, 3) : "-",
                        show_bytes(static_cast<double>(bytes_above(m))),
                        finest > 0 ? show_fixed(1.0 + ratio(bytes_above(m), finest), 3) : "-"});
    }
    return text;
}

std::string level_table(const LodTable& table) {
    std::vector<std::string> head{"level",
                                  "method",
                                  "voxels",
                                  "lobes per voxel",
                                  "size",
                                  "bytes per voxel",
                                  "parents",
                                  "sigma error",
                                  "L1 of densities",
                                  "moment, median",
                                  "moment, largest",
                                  "coverage, mean",
                                  "coverage, largest"};
    const bool lost = any_lost(table);
    if (lost) head.emplace_back("kind lost");
    std::string text = head_of(head);
    const std::size_t levels = table.methods.empty() ? 0 : table.methods[0].errors.levels.size();
    for (std::size_t l = 0; l < levels; ++l) {
        for (const MethodRow& m : table.methods) {
            const LevelErrors& e = m.errors.levels[l];
            const std::int64_t bytes = bytes_at(m, e.level);
            std::vector<std::string> row{str(e.level),
                                         m.errors.name,
                                         show_count(static_cast<double>(e.voxels)),
                                         show_fixed(ratio(e.lobes, e.voxels), 3),
                                         show_bytes(static_cast<double>(bytes)),
                                         show_fixed(ratio(bytes, e.voxels), 1),
                                         str(e.parents),
                                         show_fixed(e.sigma, 5),
                                         show_fixed(e.cells, 4),
                                         show_fixed(e.moment, 5),
                                         show_fixed(e.moment_worst, 5),
                                         show_optional(e.coverage, 5),
                                         show_optional(e.coverage_worst, 5)};
            if (lost) row.push_back(show_fixed(e.lost, 4));
            text += row_of(row);
        }
    }
    return text;
}

Json or_null(const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json json_of(const LevelErrors& e, std::int64_t bytes) {
    return {{"level", e.level},
            {"voxels", e.voxels},
            {"lobes", e.lobes},
            {"lobes_per_voxel", ratio(e.lobes, e.voxels)},
            {"bytes", bytes},
            {"bytes_per_voxel", ratio(bytes, e.voxels)},
            {"parents", e.parents},
            {"sigma_error", e.sigma},
            {"density_l1", e.cells},
            {"moment_median", e.moment},
            {"moment_largest", e.moment_worst},
            {"coverage_mean", or_null(e.coverage)},
            {"coverage_largest", or_null(e.coverage_worst)},
            {"kind_lost", e.lost}};
}

/// A colour that people tell apart whatever colours they see [Okabe and Ito 2008], and a wide grey
/// line for the file's own levels, which others cover.
PlotLine line_of(const std::string& name) {
    PlotLine line;
    line.name = name;
    static const std::vector<std::pair<std::string, std::array<std::uint8_t, 3>>> colors{
        {"moments", {0, 114, 178}},  {"wasserstein", {230, 159, 0}},
        {"single", {213, 94, 0}},    {"naive", {0, 158, 115}},
        {"random", {204, 121, 167}}, {"interpolate", {86, 180, 233}}};
    line.color = {190, 190, 190};
    line.width = 9.0;
    for (const auto& [of, color] : colors) {
        if (of != name) continue;
        line.color = color;
        line.width = 3.0;
    }
    return line;
}

} // namespace

std::string markdown_of(const LodTable& table) {
    std::string text = str(
        head_text(table), "\n", method_table(table), "\n", level_table(table), "\n",
        "Size: of the grids in a .vdb; `times level 0` is the size of all levels divided by that of level 0, without columns and sums.\n"
        "Errors: compared with all finest lobes below a voxel. "
        "Sigma error: mean over 500 directions of the difference in projected area. "
        "L1 of densities: over 768 cells of the sphere; the noise of the reference is about 0.016. "
        "Moment: largest difference of an entry of the second moment. "
        "Coverage: over the three axes.");
    if (any_lost(table)) {
        text +=
            " kind lost: share of the directed area whose kind (tangents or normals) no lobe keeps; the other errors leave it out.";
    }
    return text + "\n";
}

void add_json(const LodTable& table, Report& report) {
    report.data("file", table.file);
    report.data("lod", table.lod);
    report.data("approximate", table.approximate);
    constexpr std::array<const char*, 3> kTruths{"union", "file", "none"};
    report.data("coverage_truth", kTruths[static_cast<std::size_t>(table.coverage)]);
    report.data("finest", {{"voxels", table.voxels},
                           {"lobes", table.lobes},
                           {"part_of_voxels", table.part_of > 0 ? table.part_of : table.voxels},
                           {"bytes", table.finest_bytes},
                           {"mask_bytes", table.mask_bytes}});
    Json methods = Json::array();
    for (const MethodRow& m : table.methods) {
        Json levels = Json::array();
        for (const LevelErrors& e : m.errors.levels) {
            levels.push_back(json_of(e, bytes_at(m, e.level)));
        }
        methods.push_back({{"name", m.errors.name},
                           {"build_seconds", or_null(m.build_seconds)},
                           {"bytes", bytes_above(m)},
                           {"levels", std::move(levels)}});
    }
    report.data("methods", std::move(methods));
}

std::vector<PlotPanel> panels_of(const LodTable& table) {
    std::vector<PlotPanel> panels{{"error of projected area, mean", "level", true, {}},
                                  {"l1 distance of densities, mean", "level", true, {}}};
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

} // namespace heddle::cli
