#pragma once

#include <heddle/base/progress.h>
#include <heddle/io/vol/vol_layout.h>
#include <heddle/job/levels.h>
#include <heddle/job/phase_clock.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// How a Mitsuba volume is converted to voxels, one per sample. Nothing is required.
struct VolJobOptions {
    std::string orientation{};             ///< orientation file, or "none"; empty: found by name
    std::optional<double> density_scale{}; ///< extinction per scene unit at density 1; none:
                                           ///< density 1 covers 86 % of a voxel's face
    Vec3f albedo{0.8f, 0.8f, 0.8f};        ///< of the fibers, linear RGB in [0, 1]
    std::int32_t lobes = 3;                ///< most per voxel, 1 to 8
    bool occupancy = true;                 ///< stores for each voxel that any cell may be occupied
    LodMethod lod = LodMethod::Moments;
    std::optional<int> levels{}; ///< most levels above the finest; none: all
    std::uint64_t seed = 0;
    std::optional<std::int64_t> memory_bytes{}; ///< limit; none: half of the free memory
    std::string command{};                      ///< is stored in the result
};

/// What was converted. In a plan, only `layout` is filled in.
struct VolReport {
    VolLayout layout{};
    std::vector<std::string> notes{};
    LevelCounts counts{};
    std::int64_t file_bytes = 0; ///< of the .vdb; 0: none was written
    PhaseTimes phases{};
    double seconds = 0.0;
    std::int64_t peak_bytes = 0; ///< resident, of the process so far
};

/// A Mitsuba volume in memory.
struct VolResult {
    VoxelLevels levels{}; ///< finest first; may read the input files later
    VolReport report{};
};

/// Returns true if the path ends in .vol.
[[nodiscard]] bool is_vol_file(const std::string& path);

/// Finds the files of a volume and the layout of its samples.
/// @param path    of the density, or of a dictionary of blocks
/// @throws Error  as find_vol_layout
[[nodiscard]] VolReport
plan_vol(const std::string& path, const VolJobOptions& options, Progress& progress);

/// Converts a Mitsuba volume to voxels and builds their levels of detail, in memory.
/// @throws OptionError  a number is out of range
/// @throws Error        as find_vol_layout and read_vol; Cancelled
[[nodiscard]] VolResult
voxelize_vol(const std::string& path, const VolJobOptions& options, Progress& progress);

/// Converts a Mitsuba volume and writes a .vdb.
/// @throws Error  as voxelize_vol; CannotWrite
VolReport voxelize_vol_to_file(const std::string& path,
                               const std::string& output,
                               const VolJobOptions& options,
                               Progress& progress);

} // namespace heddle::job
