#pragma once

#include <heddle/cli/terminal/option.h>
#include <heddle/job/view/view_options.h>

#include <vector>

namespace heddle::cli {

/// Returns the rows of `heddle view`.
[[nodiscard]] std::vector<Option> view_rows();

/// Return what is shown, and the initial settings, as those rows give them.
[[nodiscard]] job::ViewInput view_input_from(const Arguments& arguments);
[[nodiscard]] job::ViewOptions view_options_from(const Arguments& arguments);

} // namespace heddle::cli
