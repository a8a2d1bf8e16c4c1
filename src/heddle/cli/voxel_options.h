#pragma once

#include <heddle/cli/terminal/option.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/voxelize/voxelize.h>

#include <vector>

namespace heddle::cli {

/// The rows that choose the lattice: --voxel-size, --voxels.
[[nodiscard]] std::vector<Option> resolution_options();

/// What those rows say; all else is the default.
/// @throws UsageError  both are given
[[nodiscard]] VoxelizeOptions resolution_from(const Arguments& arguments);

/// Rows on how much work a plan is: primitives, steps, voxels, predicted bytes and time.
/// @return  predicted bytes of the file
std::int64_t report_work(Report& report, const VoxelizePlan& plan);

} // namespace heddle::cli
