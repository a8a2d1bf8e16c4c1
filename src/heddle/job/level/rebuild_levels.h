#pragma once

#include <heddle/base/progress.h>
#include <heddle/job/levels.h>
#include <heddle/job/stage_clock.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// How levels of detail are built again. Nothing is required.
struct RebuildLevelsOptions {
    LodMethod lod = LodMethod::Moments;
    std::optional<int> levels{}; ///< above the finest, at most; none: all
    std::optional<int> lobes{};  ///< most in a voxel above the finest, 1 to 8; none: as the finest
    bool exact = false;          ///< refuses what has no masks: its levels would be approximate
    std::uint64_t seed = 0;
};

struct RebuildLevelsReport {
    LevelCounts counts{};
    bool approximate = false; ///< the levels were built from stored lobes, not from sums
    std::vector<std::string> notes{};
    StageTimes stages{};
    double seconds = 0.0;
    std::int64_t peak_bytes = 0; ///< resident, of the process so far
};

struct RebuildLevelsResult {
    VoxelLevels levels{}; ///< finest first
    RebuildLevelsReport report{};
};

/// Builds the levels over the finest one again.
/// @param levels  finest first, at least one; taken apart
/// @throws OptionError  a number out of range; `exact` without masks
/// @throws Error        Cancelled
[[nodiscard]] RebuildLevelsResult
rebuild_levels(VoxelLevels levels, const RebuildLevelsOptions& options, Progress& progress);

/// The same from a .vdb into one, which may be the same.
/// @throws OptionError  a number out of range
/// @throws Error        as read_levels; BadFile: `exact` without masks; OutOfMemory, CannotWrite,
///                      Cancelled
RebuildLevelsReport rebuild_levels_to_file(const std::string& path,
                                           const std::string& output,
                                           const RebuildLevelsOptions& options,
                                           Progress& progress);

} // namespace heddle::job
