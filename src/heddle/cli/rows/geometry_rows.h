#pragma once

#include <heddle/cli/terminal/option.h>
#include <heddle/job/geometry_input.h>

#include <vector>

namespace heddle::cli {

/// Returns the rows for reading a file: --yarn-radius, --repeat.
[[nodiscard]] std::vector<Option> load_rows();

/// Returns the rows that modify geometry after it is read: --yarn, --fibers, --fiber-radius,
/// --height-map and so on.
[[nodiscard]] std::vector<Option> model_rows();

/// Returns the options that those rows give.
/// @param arguments  of a command with load_rows() and model_rows(); the rows for height maps may
///                   be missing
[[nodiscard]] job::GeometryOptions geometry_options_from(const Arguments& arguments);

} // namespace heddle::cli
