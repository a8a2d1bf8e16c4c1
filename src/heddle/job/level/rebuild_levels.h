#pragma once

#include <heddle/base/progress.h>
#include <heddle/job/levels.h>
#include <heddle/job/phase_clock.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// How the levels of an object are rebuilt. Nothing is required.
struct RebuildLevelsOptions {
    LodMethod lod = LodMethod::Moments;
    std::optional<int> levels{}; ///< most levels above the finest; none: all
    std::optional<int> lobes{};  ///< most per voxel above level 0, 1 to 8; none: as in level 0
    bool exact = false;          ///< refuses an input without columns and sums
    std::uint64_t seed = 0;
};

/// What was built.
struct RebuildLevelsReport {
    LevelCounts counts{};
    bool approximate = false; ///< the levels were built from stored lobes, not from sums
    std::vector<std::string> notes{};
    PhaseTimes phases{};
    double seconds = 0.0;
    std::int64_t peak_bytes = 0; ///< resident, of the process so far
};

/// The rebuilt levels in memory.
struct RebuildLevelsResult {
    VoxelLevels levels{}; ///< finest first
    RebuildLevelsReport report{};
};

/// Builds all levels above the finest one anew.
/// @param levels  finest first, at least one; the others are discarded
/// @throws OptionError  a number is out of range; `exact` without columns and sums
/// @throws Error        Cancelled
[[nodiscard]] RebuildLevelsResult
rebuild_levels(VoxelLevels levels, const RebuildLevelsOptions& options, Progress& progress);

/// Rebuilds the levels of a .vdb and writes a .vdb, which may replace the input.
/// @throws OptionError  a number is out of range; another suffix than .vdb
/// @throws Error        as read_levels; BadFile: `exact` without columns and sums; OutOfMemory,
///                      CannotWrite, Cancelled
RebuildLevelsReport rebuild_levels_to_file(const std::string& path,
                                           const std::string& output,
                                           const RebuildLevelsOptions& options,
                                           Progress& progress);

} // namespace heddle::job
