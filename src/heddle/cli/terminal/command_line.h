#pragma once

#include <heddle/cli/terminal/option.h>

#include <string>
#include <vector>

namespace heddle::cli {

/// Reads the words behind a subcommand's name.
/// @param command_line  kept in the result
/// @throws UsageError   an unknown option (names the nearest), a value that the table does not
///                      allow, a missing or a second value, something required that is not there
[[nodiscard]] Arguments parse_arguments(const Command& command,
                                        const std::vector<std::string>& words,
                                        const std::string& command_line);

/// True when the words ask for --help.
[[nodiscard]] bool wants_help(const std::vector<std::string>& words);

/// The options that every subcommand has.
[[nodiscard]] const std::vector<Option>& common_rows();

/// A command's own options, then these.
[[nodiscard]] std::vector<Option> with_common(const Command& command);

} // namespace heddle::cli
