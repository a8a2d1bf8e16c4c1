#pragma once

#include <heddle/cli/terminal/option.h>
#include <heddle/job/view/view_options.h>

#include <vector>

namespace heddle::cli {

/// The rows of `heddle view`.
[[nodiscard]] std::vector<Option> view_rows();

/// What is looked at, and how at first, as those rows say.
[[nodiscard]] job::ViewInput view_input_from(const Arguments& arguments);
[[nodiscard]] job::ViewOptions view_options_from(const Arguments& arguments);

} // namespace heddle::cli
