#include <heddle/cli/terminal/help_text.h>

#include <heddle/base/error.h>
#include <heddle/cli/terminal/command_line.h>
#include <heddle/cli/terminal/text.h>

#include <algorithm>
#include <utility>

namespace heddle::cli {
namespace {

/// Returns the value of an option that is not given, or its description.
std::string shown_preset(const Option& option) {
    const std::string& preset = option.preset;
    return preset.starts_with('(') ? preset.substr(1, preset.size() - 2) : preset;
}

/// Returns "[scene units; > 0; default: 512]" in pieces; a line may end after each.
std::vector<std::string> bracket(const Option& option) {
    std::vector<std::string> parts;
    const auto add = [&parts](const std::string& part) {
        if (!part.empty()) parts.push_back(part);
    };
    add(option.unit);
    if (option.repeats) add("can be repeated");
    add(option.values.range());
    if (!option.preset.empty()) add("default: " + shown_preset(option));
    std::vector<std::string> pieces;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::string part =
            (i == 0 ? "[" : "") + parts[i] + (i + 1 < parts.size() ? ";" : "]");
        const bool whole = part.size() <= 40;
        for (std::string& piece : whole ? std::vector{part} : split(part, ' ')) {
            pieces.push_back(std::move(piece));
        }
    }
    return pieces;
}

std::string left_column(const Option& option) {
    return option.metavar.empty() ? option.names : option.names + " " + option.metavar;
}

std::string escape_bars(std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
        text.insert(at, "\\");
    }
    return text;
}

std::string markdown_row(const Option& option) {
    const std::string preset = option.required ? "required" : shown_preset(option);
    return str("| `", escape_bars(left_column(option)), "` | ", escape_bars(preset), " | ",
               escape_bars(option.values.range()), " | ", option.unit, " | ",
               escape_bars(option.text), " |\n");
}

/// Returns a section with a table, in which the names of groups are bold rows.
std::string markdown_table(const std::string& title,
                           const std::string& summary,
                           const std::vector<Option>& options) {
    std::string text =
        str("## ", title, "\n\n", summary, "\n\n",
            "| option | default | range | unit | what it does |\n", "|---|---|---|---|---|\n");
    std::string group;
    for (const Option& option : options) {
        if (option.group != group) text += str("| **", option.group, "** | | | | |\n");
        group = option.group;
        text += markdown_row(option);
    }
    return text + "\n";
}

constexpr std::size_t kHelpWidth = 100; // columns

/// Breaks pieces into lines of at most kHelpWidth columns. The first begins at column `indent`.
std::string wrap(const std::vector<std::string>& pieces, std::size_t indent) {
    std::string out;
    std::size_t column = indent;
    for (const std::string& piece : pieces) {
        const bool first = column == indent;
        if (!first && column + 1 + piece.size() > kHelpWidth) {
            out += "\n" + std::string(indent, ' ');
            column = indent;
        } else if (!first) {
            out += ' ';
            ++column;
        }
        out += piece;
        column += piece.size();
    }
    return out;
}

/// Returns the text that --help has beside the name of an option.
std::string right_column(const Option& option, std::size_t indent) {
    std::vector<std::string> pieces = split(option.text, ' ');
    for (std::string& piece : bracket(option)) pieces.push_back(std::move(piece));
    return wrap(pieces, indent);
}

} // namespace

std::string help_text(const Command& command) {
    std::string usage = "heddle " + command.name;
    for (const Option& option : command.options) {
        if (!option.required) continue;
        usage += " " + option.names.substr(0, option.names.find(','));
        if (!option.metavar.empty()) usage += " " + option.metavar;
    }
    const std::vector<Option> options = with_common(command);
    std::size_t width = 0;
    for (const Option& option : options) width = std::max(width, left_column(option).size());
    std::string text = str("usage: ", usage, " [options]\n", command.summary, "\n");
    std::string group;
    for (const Option& option : options) {
        if (option.group != group) text += str("\n", option.group, ":\n");
        group = option.group;
        const std::string left = left_column(option);
        text += str("  ", left, std::string(width + 2 - left.size(), ' '),
                    right_column(option, width + 4), "\n");
    }
    return text;
}

std::string markdown_tables(const std::vector<Command>& commands) {
    std::string text;
    for (const Command& command : commands) {
        text += markdown_table("heddle " + command.name, command.summary, command.options);
    }
    return text +
           markdown_table("Every command", "These options exist in every command.", common_rows());
}

} // namespace heddle::cli
