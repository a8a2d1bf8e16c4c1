#pragma once

#include <heddle/cli/terminal/option.h>
#include <heddle/viewer/session/session.h>
#include <heddle/viewer/session/settings.h>

#include <vector>

namespace heddle::cli {

/// The rows of `heddle view`.
[[nodiscard]] std::vector<Option> view_options();

/// FILE is a volume.
[[nodiscard]] bool is_volume_file(const Arguments& arguments);

/// What does not go together, before anything is read.
/// @throws UsageError
void check_view(const Arguments& arguments);

/// What a view begins with; its orbit is about the unit ball (Settings::framed).
[[nodiscard]] viewer::Settings view_settings(const Arguments& arguments,
                                             const viewer::Subject& subject);

} // namespace heddle::cli
