#pragma once

#include <heddle/cli/terminal/report.h>
#include <heddle/job/levels.h>
#include <heddle/job/phase_clock.h>
#include <heddle/job/voxelize/voxelize_vol.h>

#include <string>
#include <vector>

namespace heddle::cli {

/// "1, 2, 3".
[[nodiscard]] std::string show(Vec3d v);

/// Rows on the voxels and lobes of level 0, and of the levels above it.
void report_levels(Report& report, const job::LevelCounts& counts);

/// Rows on how much work a plan is: primitives, steps, voxels, predicted bytes and time.
void report_work(Report& report, const VoxelizePlan& plan, std::int64_t predicted_file_bytes);

/// Rows on what a .vol holds.
void report_vol(Report& report, const VolLayout& layout);

void report_notes(Report& report, const std::vector<std::string>& notes);

/// A row a phase.
void report_phases(Report& report, const job::PhaseTimes& phases);

/// Rows on the whole time and the memory.
void report_cost(Report& report, double seconds, std::int64_t peak_bytes);

} // namespace heddle::cli
