#pragma once

#include <heddle/cli/terminal/option.h>

#include <vector>

namespace heddle {
struct VolLayout;
}

namespace heddle::cli {

/// The rows that say how a .vol is read: --orientation, --density-scale, --albedo.
[[nodiscard]] std::vector<Option> volume_options();

/// True when the input is a .vol: its samples are voxels already.
[[nodiscard]] bool is_volume(const Arguments& arguments);

/// @throws UsageError  one of volume_options() is given for what is no .vol
void refuse_volume_options(const Arguments& arguments);

/// `voxelize` of a .vol.
/// @throws Error       as find_vol_layout, read_vol and write_vdb
/// @throws UsageError  an option that a volume has no use for
void voxelize_volume(const Arguments& arguments, Report& report, ProgressBar& bar);

/// Rows on what a .vol holds.
void report_vol(Report& report, const VolLayout& layout);

} // namespace heddle::cli
