#pragma once

#include <heddle/cli/terminal/report.h>
#include <heddle/job/voxelize/voxelize_frames.h>

#include <string>
#include <vector>

namespace heddle::cli {

/// Adds rows for a plan and, if a .vdb was written, for the result.
void report_voxelize(Report& report, const job::VoxelizeReport& done, const std::string& output);

/// Adds a row for each frame, and sums over all frames.
/// @param done  one report per frame
void report_frames(Report& report,
                   const std::vector<job::AnimationFrame>& frames,
                   const std::vector<job::VoxelizeReport>& done);

} // namespace heddle::cli
