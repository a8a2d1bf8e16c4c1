#include <heddle/base/error.h>
#include <heddle/base/nearest_name.h>
#include <heddle/cli/terminal/command_line.h>
#include <heddle/cli/terminal/text.h>

#include <CLI/CLI.hpp>

#include <algorithm>

namespace heddle::cli {
namespace {

/// Returns the long names of options, or the names of arguments without dashes. Errors use them
/// and suggest the nearest.
std::string spoken_name(const Option& option) {
    return option.positional() ? option.names : "--" + option.key();
}

[[noreturn]] void
refuse_extra(const Command& command, const std::vector<Option>& options, const std::string& word) {
    const std::string see = str("see heddle ", command.name, " --help");
    if (word.size() < 2 || word.front() != '-') {
        throw UsageError(str("unexpected argument '", word, "'; ", see));
    }
    const std::string name = word.substr(0, word.find('='));
    std::vector<std::string> known;
    for (const Option& option : options) {
        if (!option.positional()) known.push_back(option.key());
    }
    const std::size_t dashes = std::min(name.find_first_not_of('-'), name.size());
    const std::string_view near = nearest_name(std::string_view(name).substr(dashes), known);
    throw UsageError(str("unknown option '", name, "'; ",
                         near.empty() ? see : str("did you mean '--", near, "'?")));
}

void check_values(const Option& option, const std::vector<std::string>& values) {
    if (values.size() > 1 && !option.repeats) {
        throw UsageError(
            str(spoken_name(option), " is given ", values.size(), " times; give it once"));
    }
    for (const std::string& value : values) {
        const std::string problem = option.values.problem(value);
        if (!problem.empty()) throw UsageError(str(spoken_name(option), ": ", problem));
    }
}

/// Returns the unchecked values of each option. The value of a flag is its name.
std::vector<std::vector<std::string>> sort_words(const Command& command,
                                                 const std::vector<Option>& options,
                                                 const std::vector<std::string>& words) {
    CLI::App app;
    app.set_help_flag();
    app.allow_extras();
    std::vector<std::vector<std::string>> values(options.size());
    for (std::size_t i = 0; i < options.size(); ++i) {
        std::string names = options[i].names;
        std::erase(names, ' ');
        if (options[i].values.kind == ValueKind::Flag) {
            app.add_flag_callback(names, [&, i] { values[i].push_back(options[i].names); });
            continue;
        }
        CLI::Option* parsed = app.add_option(names, values[i]);
        parsed->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        parsed->expected(1)->allow_extra_args(false)->type_name(options[i].metavar);
    }
    try {
        // the library expects the last word first
        app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    } catch (const CLI::ParseError& e) {
        throw UsageError(e.what());
    }
    std::vector<std::string> extra = app.remaining();
    std::erase(extra, "--"); // the mark before words that are no options
    if (!extra.empty()) {
        const auto option = std::find_if(extra.begin(), extra.end(), [](const std::string& word) {
            return word.size() > 1 && word.front() == '-';
        });
        refuse_extra(command, options, option != extra.end() ? *option : extra.front());
    }
    return values;
}

} // namespace

std::vector<Option> with_common(const Command& command) {
    std::vector<Option> options = command.options;
    const std::vector<Option>& common = common_rows();
    options.insert(options.end(), common.begin(), common.end());
    return options;
}

const std::vector<Option>& common_rows() {
    static const std::vector<Option> options = grouped(
        "General",
        {
            {"--threads", "N", "0", integer(0, 4096), "", "Number of threads; 0 = one per core."},
            {"--seed", "N", "0", integer(0, 4294967295), "", "Seed of all random choices."},
            {"--json", "", "", flag(), "", "Prints the results as one JSON object."},
            {"--quiet", "", "", flag(), "",
             "Prints errors only: no progress, notes or results table."},
            {"-h, --help", "", "", flag(), "", "Prints this help."},
        });
    return options;
}

bool wants_help(const std::vector<std::string>& words) {
    return std::any_of(words.begin(), words.end(),
                       [](const std::string& word) { return word == "--help" || word == "-h"; });
}

Arguments parse_arguments(const Command& command,
                          const std::vector<std::string>& words,
                          const std::string& command_line) {
    const std::vector<Option> options = with_common(command);
    const std::vector<std::vector<std::string>> values = sort_words(command, options, words);
    Arguments arguments;
    arguments.command_line = command_line;
    for (std::size_t i = 0; i < options.size(); ++i) {
        const Option& option = options[i];
        arguments.set_preset(option.key(), option.preset);
        if (!values[i].empty()) {
            check_values(option, values[i]);
            arguments.set(option.key(), values[i]);
        } else if (option.required) {
            throw UsageError(str(option.positional() ? "" : "option ", spoken_name(option),
                                 " is missing; see heddle ", command.name, " --help"));
        }
    }
    return arguments;
}

} // namespace heddle::cli
