#pragma once

#include <heddle/cli/terminal/option.h>
#include <heddle/job/geometry_input.h>

#include <vector>

namespace heddle::cli {

/// The rows that say how a file is read: --yarn-radius, --repeat.
[[nodiscard]] std::vector<Option> load_rows();

/// The rows that say what becomes of what was read: --yarn, --fibers, --fiber-radius,
/// --height-map...
[[nodiscard]] std::vector<Option> model_rows();

/// What those rows say.
/// @param arguments  with the rows of load_rows() and model_rows(), or without those of height maps
[[nodiscard]] job::GeometryOptions geometry_options_from(const Arguments& arguments);

} // namespace heddle::cli
