#pragma once

#include <heddle/cli/plot.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/lod/level_report.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heddle::cli {

/// What `lod-report` found of one method, or of the levels that the file holds.
struct MethodRow {
    std::optional<double> build_seconds; ///< all levels, one pass; none of the file's own
    std::vector<std::int64_t> bytes;     ///< of the grids in a .vdb, by level from 0
    MethodErrors errors;
};

/// What `lod-report` found, for its three forms.
struct LodTable {
    std::string file;
    std::string lod;          ///< method by which the file's own levels were built
    bool approximate = false; ///< the file has no sums: levels are built from stored lobes
    CoverageTruth coverage = CoverageTruth::None;
    std::int64_t voxels = 0; ///< of the finest level, in the part
    std::int64_t lobes = 0;
    std::int64_t part_of = 0;             ///< voxels of the whole; 0: nothing was left out
    std::int64_t finest_bytes = 0;        ///< level 0 of the whole without columns and sums
    std::int64_t mask_bytes = 0;          ///< its columns and sums
    std::vector<std::int64_t> file_bytes; ///< by level
    std::vector<MethodRow> methods;       ///< "file" first unless there is a part
};

/// Two tables and the sentences that they need.
[[nodiscard]] std::string markdown_of(const LodTable& table);

/// The same numbers under keys, in JSON alone.
void add_json(const LodTable& table, Report& report);

/// Errors of projected area, of densities and, where it is known, of coverage by level.
[[nodiscard]] std::vector<PlotPanel> panels_of(const LodTable& table);

} // namespace heddle::cli
