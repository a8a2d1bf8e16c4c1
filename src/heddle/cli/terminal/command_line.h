#pragma once

#include <heddle/cli/terminal/option.h>

#include <string>
#include <vector>

namespace heddle::cli {

/// Reads the words that follow the name of a subcommand.
/// @param command_line  kept in the result
/// @throws UsageError   an option is unknown (the text names the nearest one), a value is missing,
///                      given twice or not allowed by the table, or a required option is missing
[[nodiscard]] Arguments parse_arguments(const Command& command,
                                        const std::vector<std::string>& words,
                                        const std::string& command_line);

/// Returns true if the words ask for --help.
[[nodiscard]] bool wants_help(const std::vector<std::string>& words);

/// Returns the options that every subcommand has.
[[nodiscard]] const std::vector<Option>& common_rows();

/// Returns the options of a command, followed by those that every subcommand has.
[[nodiscard]] std::vector<Option> with_common(const Command& command);

} // namespace heddle::cli
