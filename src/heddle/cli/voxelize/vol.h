#pragma once

#include <heddle/cli/terminal/option.h>

#include <vector>

namespace heddle::cli {

/// Returns the rows for reading a .vol: --orientation, --density-scale, --albedo.
[[nodiscard]] std::vector<Option> vol_rows();

/// Checks that a file that is not a .vol is given without vol_rows().
/// @throws UsageError  one of them is given
void reject_vol_rows(const Arguments& arguments);

/// Runs `voxelize` for a .vol.
/// @throws UsageError  an option is given that a volume has no use for
/// @throws Error       as job::voxelize_vol_to_file
void voxelize_vol(const Arguments& arguments, Report& report, ProgressBar& bar);

} // namespace heddle::cli
