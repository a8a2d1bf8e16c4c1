#pragma once

#include <heddle/base/progress.h>
#include <heddle/job/phase_clock.h>
#include <heddle/lod/level_report.h>
#include <heddle/lod/method.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// How levels of detail are measured. Nothing is required.
struct MeasureLevelsOptions {
    /// levels are built by each of these methods
    std::vector<LodMethod> methods{LodMethod::Moments, LodMethod::Single, LodMethod::Naive,
                                   LodMethod::Random, LodMethod::Interpolate};
    int parents = 2000; ///< most voxels that are measured per level, >= 1
    std::optional<std::int64_t>
        part{}; ///< about how many voxels of the finest level are used; none:
                ///< all, or 50,000 with the method `wasserstein`
    std::optional<int>
        lobes{}; ///< most per voxel of the built levels, 1 to 8; none: as in the input
    std::uint64_t seed = 0;
    std::optional<std::string> plot{}; ///< path of an .svg that shows the errors by level
};

/// The results of one method, or of the levels that the input has.
struct MethodRow {
    std::optional<double> build_seconds{}; ///< all levels, one pass; none: those of the input
    std::vector<std::int64_t> bytes{};     ///< of the grids in a .vdb, per level from 0
    MethodErrors errors{};

    [[nodiscard]] std::int64_t bytes_at(int level) const {
        const auto at = static_cast<std::size_t>(level);
        return at < bytes.size() ? bytes[at] : 0;
    }
    /// Returns the bytes of all levels above 0.
    [[nodiscard]] std::int64_t bytes_above() const {
        std::int64_t sum = 0;
        for (std::size_t l = 1; l < bytes.size(); ++l) sum += bytes[l];
        return sum;
    }
};

/// The results of all methods.
struct LevelTable {
    std::string file{};       ///< path; empty: in memory
    std::string lod{};        ///< method by which the input's levels were built
    bool approximate = false; ///< the input has no sums, so levels are built from lobes
    CoverageTruth coverage = CoverageTruth::None;
    std::int64_t voxels = 0; ///< of the finest level, in the part that is measured
    std::int64_t lobes = 0;
    std::int64_t part_of = 0;               ///< voxels of the whole level; 0: all were measured
    std::int64_t finest_bytes = 0;          ///< whole level 0 without columns and sums
    std::int64_t mask_bytes = 0;            ///< columns and sums of the whole level 0
    std::vector<std::int64_t> file_bytes{}; ///< per level
    std::vector<MethodRow> methods{};       ///< "file" first, unless only a part is measured
    std::vector<std::string> notes{};
    PhaseTimes phases{};
    std::int64_t peak_bytes = 0; ///< resident, of the process so far
};

/// Compares an object's levels, and levels that each method builds, with the finest level.
/// @param levels  finest first, at least two
/// @throws OptionError  a number is out of range; the part is too small for a level above it
/// @throws Error        CannotWrite: no folder for temporary files; Cancelled
[[nodiscard]] LevelTable
measure_levels(const VoxelLevels& levels, const MeasureLevelsOptions& options, Progress& progress);

/// Compares the levels of a .vdb.
/// @throws Error  also as read_levels; BadFile: the file has only the finest level
[[nodiscard]] LevelTable
measure_levels(const std::string& path, const MeasureLevelsOptions& options, Progress& progress);

} // namespace heddle::job
