#pragma once

#include <heddle/cli/terminal/option.h>
#include <heddle/job/levels.h>

#include <optional>
#include <vector>

namespace heddle::cli {

/// Returns the rows for building levels of detail: --levels, --lod.
[[nodiscard]] std::vector<Option> level_rows();

/// Returns the value of --lod.
[[nodiscard]] LodMethod lod_method_from(const Arguments& arguments);

/// Returns the value of --levels; none: all.
/// @throws UsageError  the number of levels is out of range
[[nodiscard]] std::optional<int> level_count_from(const Arguments& arguments);

} // namespace heddle::cli
