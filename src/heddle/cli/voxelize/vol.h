#pragma once

#include <heddle/cli/terminal/option.h>

#include <vector>

namespace heddle::cli {

/// The rows that say how a .vol is read: --orientation, --density-scale, --albedo.
[[nodiscard]] std::vector<Option> vol_rows();

/// @throws UsageError  one of vol_rows() is given for what is no .vol
void reject_vol_rows(const Arguments& arguments);

/// `voxelize` of a .vol.
/// @throws UsageError  an option that a volume has no use for
/// @throws Error       as job::voxelize_vol_to_file
void voxelize_vol(const Arguments& arguments, Report& report, ProgressBar& bar);

} // namespace heddle::cli
