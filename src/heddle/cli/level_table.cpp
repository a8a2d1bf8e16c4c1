#include <heddle/base/format_number.h>
#include <heddle/cli/level_table.h>

#include <heddle/base/error.h>
#include <heddle/cli/terminal/text.h>

#include <algorithm>
#include <utility>

namespace heddle::cli {
namespace {

double ratio(std::int64_t a, std::int64_t b) {
    return b > 0 ? static_cast<double>(a) / static_cast<double>(b) : 0.0;
}

std::string show_optional(const std::optional<double>& value, int decimals) {
    return value ? format_fixed(*value, decimals) : "-";
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

bool any_lost(const job::LevelTable& table) {
    for (const job::MethodRow& method : table.methods) {
        for (const LevelErrors& e : method.errors.levels) {
            if (e.lost > 0.0) return true;
        }
    }
    return false;
}

std::string head_text(const job::LevelTable& table) {
    const auto count = [](std::int64_t n) { return format_count(static_cast<double>(n)); };
    std::string text = str("# Levels of detail of `", table.file, "`\n\n");
    text += str("Finest level: ", count(table.voxels), " voxels, ",
                format_fixed(ratio(table.lobes, table.voxels), 3), " lobes per voxel");
    if (table.part_of > 0) {
        text += str(", a part of ", count(table.part_of),
                    " voxels (above level 5, children are missing)");
    }
    text += str("; size in the file ", format_bytes(static_cast<double>(table.finest_bytes)));
    if (table.mask_bytes > 0) {
        text += str(" and ", format_bytes(static_cast<double>(table.mask_bytes)),
                    " of columns and sums");
    }
    text += str(". The file's levels were built by `", table.lod, "`. ");
    if (table.approximate)
        text +=
            "The file has no sums: levels are built from the stored lobes (approximate), and the finest lobes are weighted by mean optical depth. "
            "The file's own levels were weighted by sums, so their errors include that difference. ";
    return text + str("Coverage is compared with ", coverage_words(table.coverage), ".\n");
}

std::string method_table(const job::LevelTable& table) {
    std::string text = head_of({"method", "build time, s", "million finest voxels per second",
                                "size above level 0", "times level 0"});
    const std::int64_t finest = table.part_of > 0 ? 0 : table.finest_bytes;
    for (const job::MethodRow& m : table.methods) {
        const double seconds = m.build_seconds.value_or(0.0);
        const double rate = static_cast<double>(table.voxels) / std::max(1e-9, seconds) * 1e-6;
        text += row_of({m.errors.name, show_optional(m.build_seconds, 2),
                        m.build_seconds ? format_fixed(rate, 3) : "-",
                        format_bytes(static_cast<double>(m.bytes_above())),
                        finest > 0 ? format_fixed(1.0 + ratio(m.bytes_above(), finest), 3) : "-"});
    }
    return text;
}

std::string level_table(const job::LevelTable& table) {
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
        for (const job::MethodRow& m : table.methods) {
            const LevelErrors& e = m.errors.levels[l];
            const std::int64_t bytes = m.bytes_at(e.level);
            std::vector<std::string> row{str(e.level),
                                         m.errors.name,
                                         format_count(static_cast<double>(e.voxels)),
                                         format_fixed(ratio(e.lobes, e.voxels), 3),
                                         format_bytes(static_cast<double>(bytes)),
                                         format_fixed(ratio(bytes, e.voxels), 1),
                                         str(e.parents),
                                         format_fixed(e.sigma, 5),
                                         format_fixed(e.cells, 4),
                                         format_fixed(e.moment, 5),
                                         format_fixed(e.moment_worst, 5),
                                         show_optional(e.coverage, 5),
                                         show_optional(e.coverage_worst, 5)};
            if (lost) row.push_back(format_fixed(e.lost, 4));
            text += row_of(row);
        }
    }
    return text;
}

} // namespace

std::string markdown_of(const job::LevelTable& table) {
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

} // namespace heddle::cli
