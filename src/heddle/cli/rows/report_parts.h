#pragma once

#include <heddle/cli/terminal/report.h>
#include <heddle/job/levels.h>
#include <heddle/job/phase_clock.h>
#include <heddle/job/voxelize/voxelize_vol.h>

#include <string>
#include <vector>

namespace heddle::cli {

/// Returns a text such as "1, 2, 3".
[[nodiscard]] std::string show(Vec3d v);

/// Adds rows for the voxels and lobes of level 0 and of the levels above it.
void report_levels(Report& report, const job::LevelCounts& counts);

/// Adds rows for the work that a plan predicts: primitives, steps, voxels, bytes and time.
void report_work(Report& report, const VoxelizePlan& plan, std::int64_t predicted_file_bytes);

/// Adds rows for the contents of a .vol.
void report_vol(Report& report, const VolLayout& layout);

void report_notes(Report& report, const std::vector<std::string>& notes);

/// Adds a row for each phase.
void report_phases(Report& report, const job::PhaseTimes& phases);

/// Adds rows for the total time and the peak memory.
void report_cost(Report& report, double seconds, std::int64_t peak_bytes);

} // namespace heddle::cli
