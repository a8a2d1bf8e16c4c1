#pragma once

#include <heddle/base/progress.h>
#include <heddle/io/vol/vol_layout.h>
#include <heddle/job/levels.h>
#include <heddle/job/stage_clock.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// How a Mitsuba volume becomes voxels: its samples are the voxels. Nothing is required.
struct VolJobOptions {
    std::string orientation{}; ///< file of its directions, or "none"; empty: found by name
    std::optional<double> density_scale{}; ///< extinction per scene unit at density 1; none: such
                                           ///< that density 1 covers 86 % of a voxel's face
    Vec3f albedo{0.8f, 0.8f, 0.8f};        ///< linear RGB in [0, 1], of its fibers
    std::int32_t lobes = 3;                ///< most in a voxel, 1 to 8
    LodMethod lod = LodMethod::Moments;
    std::optional<int> levels{}; ///< above the finest, at most; none: all
    std::uint64_t seed = 0;
    std::optional<std::int64_t> memory_bytes{}; ///< none: half of what is free
    std::string command{};                      ///< is kept in the result
};

/// What was made of a .vol, or is there to be made: then `layout` alone is filled in.
struct VolReport {
    VolLayout layout{};
    std::vector<std::string> notes{};
    LevelCounts counts{};
    std::int64_t file_bytes = 0; ///< of the .vdb; 0: none was written
    StageTimes stages{};
    double seconds = 0.0;
    std::int64_t peak_bytes = 0; ///< resident, of the process so far
};

struct VolResult {
    VoxelLevels levels{}; ///< finest first; the files must stay while it lives
    VolReport report{};
};

/// A path that ends in .vol.
[[nodiscard]] bool is_vol_file(const std::string& path);

/// Which files make the volume, and where its samples lie.
/// @param path    of density, or a dictionary of blocks
/// @throws Error  as find_vol_layout
[[nodiscard]] VolReport
plan_vol(const std::string& path, const VolJobOptions& options, Progress& progress);

/// A Mitsuba volume as voxels with levels of detail, in memory.
/// @throws OptionError  a number out of range
/// @throws Error        as find_vol_layout and read_vol; Cancelled
[[nodiscard]] VolResult
voxelize_vol(const std::string& path, const VolJobOptions& options, Progress& progress);

/// The same into a .vdb.
/// @throws Error  as voxelize_vol; CannotWrite
VolReport voxelize_vol_to_file(const std::string& path,
                               const std::string& output,
                               const VolJobOptions& options,
                               Progress& progress);

} // namespace heddle::job
