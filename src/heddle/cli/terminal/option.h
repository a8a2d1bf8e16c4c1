#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace heddle::cli {

class Report;
class ProgressBar;

/// The command line is wrong: one sentence for the user, exit code 2.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

enum class ValueKind : std::uint8_t {
    Flag,    ///< no value
    Text,    ///< any
    Choice,  ///< one of `words`
    Integer, ///< in [lo, hi]
    Numbers, ///< least to most finite numbers in [lo, hi], joined by `separator`
    Bytes    ///< 4G, 1500M
};

/// What an option takes: parsed, checked and printed from this alone.
struct Values {
    ValueKind kind = ValueKind::Text;
    std::vector<std::string> words{};
    double lo = 0.0, hi = 0.0;
    bool above = false; ///< lo itself is not allowed
    int least = 1, most = 1;
    char separator = ',';

    /// "1 to 8", "> 0", "columns or mask"; empty where anything goes.
    [[nodiscard]] std::string range() const;
    /// What is wrong with `text` as a value, as "'x' is not ..."; empty if nothing is.
    [[nodiscard]] std::string problem(const std::string& text) const;
};

[[nodiscard]] Values flag();
[[nodiscard]] Values any_text();
[[nodiscard]] Values one_of(std::vector<std::string> words);
[[nodiscard]] Values integer(std::int64_t lo, std::int64_t hi);
[[nodiscard]] Values number(double lo, double hi);
[[nodiscard]] Values positive();
/// `least` or `most` numbers, joined by `separator`.
[[nodiscard]] Values
numbers(int least, int most, double lo, double hi, char separator = ',', bool above = false);
[[nodiscard]] Values bytes();

/// One row of a subcommand's table: the parser, --help and docs/options.md are made from it.
struct Option {
    std::string names;     ///< "-o, --output", "--voxels", or "FILE" for what needs no dash
    std::string metavar;   ///< "N"; empty for a flag
    std::string preset;    ///< value when not given; "(...)" names it in words
    Values values;         ///< range
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

/// What the user gave, checked against the table; what was not given is the row's preset.
class Arguments {
public:
    /// @param values  at least one; more than one where the option repeats
    void set(const std::string& key, const std::vector<std::string>& values) {
        given_[key] = values;
    }
    void set_preset(const std::string& key, const std::string& value) { preset_[key] = value; }

    [[nodiscard]] bool given(const std::string& key) const { return given_.contains(key); }
    [[nodiscard]] const std::string& text(const std::string& key) const;
    /// All values of an option that repeats, in their order; none if it is not given.
    [[nodiscard]] std::vector<std::string> texts(const std::string& key) const;
    [[nodiscard]] std::int64_t integer(const std::string& key) const;
    [[nodiscard]] double number(const std::string& key) const;
    [[nodiscard]] std::vector<double> numbers(const std::string& key, char separator = ',') const;
    [[nodiscard]] std::int64_t bytes(const std::string& key) const;

    std::string command_line; ///< as the user typed it, quoted where a shell needs it

private:
    std::map<std::string, std::vector<std::string>> given_;
    std::map<std::string, std::string> preset_;
};

/// One subcommand.
struct Command {
    std::string name;
    std::string summary;         ///< one sentence, for --help
    std::vector<Option> options; ///< its own; those that every command has are added
    void (*run)(const Arguments&, Report&, ProgressBar&) = nullptr;
};

} // namespace heddle::cli
