#pragma once

#include <heddle/cli/terminal/arguments.h>
#include <heddle/cli/terminal/values.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace heddle::cli {

class Report;
class ProgressBar;

/// The command line is wrong: one sentence for the user, exit code 2.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// One row of a subcommand's table: the parser, --help and docs/options.md are made from it.
struct Option {
    std::string names;     ///< "-o, --output", "--voxels", or "FILE" for what needs no dash
    std::string metavar;   ///< "N"; empty for a flag
    std::string preset;    ///< value when not given; "(...)" names it in words
    ValueRule values;      ///< range
    std::string unit;      ///< empty where it has none
    std::string text;      ///< what it does
    bool required = false; ///< must be given
    bool repeats = false;  ///< may be given more than once
    std::string group{};   ///< heading in --help; see grouped()

    /// The name that the program asks for: "output" of "-o, --output".
    [[nodiscard]] std::string key() const;
    [[nodiscard]] bool positional() const { return names.front() != '-'; }
};

/// `rows` under the heading `group`.
[[nodiscard]] std::vector<Option> grouped(const std::string& group, std::vector<Option> rows);

/// The rows of all lists. Groups are in the order of their first row, each in one piece.
[[nodiscard]] std::vector<Option> joined(const std::vector<std::vector<Option>>& lists);

/// One subcommand.
struct Command {
    std::string name;
    std::string summary;         ///< one sentence, for --help
    std::vector<Option> options; ///< its own; those that every command has are added
    void (*run)(const Arguments&, Report&, ProgressBar&) = nullptr;
};

} // namespace heddle::cli
