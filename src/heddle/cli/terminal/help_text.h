#pragma once

#include <heddle/cli/terminal/option.h>

#include <string>
#include <vector>

namespace heddle::cli {

/// Returns the text of `heddle COMMAND --help`: rows under the headings of their groups.
[[nodiscard]] std::string help_text(const Command& command);

/// Returns the rows of all tables as Markdown, for docs/options.md.
[[nodiscard]] std::string markdown_tables(const std::vector<Command>& commands);

} // namespace heddle::cli
