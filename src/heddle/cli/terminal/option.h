#pragma once

#include <heddle/cli/terminal/arguments.h>
#include <heddle/cli/terminal/values.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace heddle::cli {

class Report;
class ProgressBar;

/// The command line is wrong. The text is one sentence for the user; the exit code is 2.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// One row of a subcommand's table: the parser, --help and docs/options.md are made from it.
struct Option {
    std::string names;     ///< "-o, --output", "--voxels", or "FILE" for an argument without dashes
    std::string metavar;   ///< "N"; empty for a flag
    std::string preset;    ///< value if it is not given; "(...)" describes it in words
    ValueRule values;      ///< range
    std::string unit;      ///< empty: it has none
    std::string text;      ///< what it does
    bool required = false; ///< must be given
    bool repeats = false;  ///< may be given more than once
    std::string group{};   ///< heading in --help; see grouped()

    /// Returns the name by which Arguments finds the value: "output" for "-o, --output".
    [[nodiscard]] std::string key() const;
    [[nodiscard]] bool positional() const { return names.front() != '-'; }
};

/// Returns the rows with the heading `group`.
[[nodiscard]] std::vector<Option> grouped(const std::string& group, std::vector<Option> rows);

/// Returns the rows of all lists. The rows of a group follow each other, and groups are in the
/// order of their first rows.
[[nodiscard]] std::vector<Option> joined(const std::vector<std::vector<Option>>& lists);

/// One subcommand.
struct Command {
    std::string name;
    std::string summary;         ///< one sentence, for --help
    std::vector<Option> options; ///< without those that every command has
    void (*run)(const Arguments&, Report&, ProgressBar&) = nullptr;
};

} // namespace heddle::cli
