#pragma once

#include <heddle/cli/terminal/report.h>
#include <heddle/job/voxelize/voxelize_frames.h>

#include <string>
#include <vector>

namespace heddle::cli {

/// Rows on a plan and, where a .vdb was written, on what it came to.
void report_voxelize(Report& report, const job::VoxelizeReport& done, const std::string& output);

/// A row for each frame, and sums over them.
/// @param done  one a frame
void report_frames(Report& report,
                   const std::vector<job::AnimationFrame>& frames,
                   const std::vector<job::VoxelizeReport>& done);

} // namespace heddle::cli
