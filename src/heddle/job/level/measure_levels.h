#pragma once

#include <heddle/base/progress.h>
#include <heddle/job/stage_clock.h>
#include <heddle/lod/level_report.h>
#include <heddle/lod/method.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// How levels of detail are measured. Nothing is required.
struct MeasureLevelsOptions {
    /// levels are built by each of these
    std::vector<LodMethod> methods{LodMethod::Moments, LodMethod::Single, LodMethod::Naive,
                                   LodMethod::Random, LodMethod::Interpolate};
    int parents = 2000; ///< voxels of a level that are measured, at most, >= 1
    std::optional<std::int64_t>
        part{};                 ///< voxels of the finest level that all is built and measured
                                ///< on, about; none: all, 50,000 with `wasserstein`
    std::optional<int> lobes{}; ///< most in a voxel of the built levels, 1 to 8; none: as there is
    std::uint64_t seed = 0;
    std::optional<std::string> plot{}; ///< path of an .svg that shows the errors by level
};

/// What was found of one method, or of the levels that are there.
struct MethodRow {
    std::optional<double> build_seconds{}; ///< all levels, one pass; none of those that are there
    std::vector<std::int64_t> bytes{};     ///< of the grids in a .vdb, by level from 0
    MethodErrors errors{};

    [[nodiscard]] std::int64_t bytes_at(int level) const {
        const auto at = static_cast<std::size_t>(level);
        return at < bytes.size() ? bytes[at] : 0;
    }
    /// Of all levels above 0.
    [[nodiscard]] std::int64_t bytes_above() const {
        std::int64_t sum = 0;
        for (std::size_t l = 1; l < bytes.size(); ++l) sum += bytes[l];
        return sum;
    }
};

/// What was found of all.
struct LevelTable {
    std::string file{};       ///< path; empty: in memory
    std::string lod{};        ///< method by which its own levels were built
    bool approximate = false; ///< it has no sums: levels are built from stored lobes
    CoverageTruth coverage = CoverageTruth::None;
    std::int64_t voxels = 0; ///< of the finest level, in the part
    std::int64_t lobes = 0;
    std::int64_t part_of = 0;               ///< voxels of the whole; 0: nothing was left out
    std::int64_t finest_bytes = 0;          ///< level 0 of the whole without columns and sums
    std::int64_t mask_bytes = 0;            ///< its columns and sums
    std::vector<std::int64_t> file_bytes{}; ///< by level
    std::vector<MethodRow> methods{};       ///< "file" first unless there is a part
    std::vector<std::string> notes{};
    StageTimes stages{};
    std::int64_t peak_bytes = 0; ///< resident, of the process so far
};

/// Measures an object's levels of detail, and those that other methods build, against the finest.
/// @param levels  finest first, at least two
/// @throws OptionError  a number out of range; a part with no level above it
/// @throws Error        CannotWrite: no folder for temporary files; Cancelled
[[nodiscard]] LevelTable
measure_levels(const VoxelLevels& levels, const MeasureLevelsOptions& options, Progress& progress);

/// The same of a .vdb.
/// @throws Error  also as read_levels; BadFile: it has the finest level alone
[[nodiscard]] LevelTable
measure_levels(const std::string& path, const MeasureLevelsOptions& options, Progress& progress);

} // namespace heddle::job
