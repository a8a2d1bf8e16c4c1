#pragma once

#include <heddle/cli/terminal/option.h>
#include <heddle/job/levels.h>

#include <optional>
#include <vector>

namespace heddle::cli {

/// The rows that say which levels of detail are built: --levels, --lod.
[[nodiscard]] std::vector<Option> level_rows();

/// What --lod says.
[[nodiscard]] LodMethod lod_method_from(const Arguments& arguments);

/// What --levels says; none: all.
/// @throws UsageError  a number of levels that cannot be
[[nodiscard]] std::optional<int> level_count_from(const Arguments& arguments);

} // namespace heddle::cli
