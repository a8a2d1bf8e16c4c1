#include <heddle/base/error.h>
#include <heddle/base/nearest_name.h>
#include <heddle/base/parallel.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/terminal/command_line.h>
#include <heddle/cli/terminal/help_text.h>
#include <heddle/cli/terminal/option_words.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/cli/terminal/text.h>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>

namespace heddle::cli {
namespace {

enum ExitCode : int {
    Ok = 0,
    Failed = 1,
    Usage = 2,
    BadInput = 3,
    DeviceOrMemory = 4,
    Cancelled = 130 // as a shell calls a program that Ctrl-C ended
};

ExitCode exit_code(const Error& error) {
    switch (error.code()) {
    case ErrorCode::InvalidArgument: return error.where().path.empty() ? Usage : BadInput;
    case ErrorCode::NotFound:
    case ErrorCode::BadFile:
    case ErrorCode::Unsupported: return BadInput;
    case ErrorCode::OutOfMemory:
    case ErrorCode::Device: return DeviceOrMemory;
    case ErrorCode::Cancelled: return Cancelled;
    case ErrorCode::CannotWrite:
    case ErrorCode::Internal: return Failed;
    }
    return Failed;
}

/// Prints a text as one line on stderr, even if it has line breaks.
int fail(ExitCode code, std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    std::fprintf(stderr, "heddle: %s\n", text.c_str());
    return code;
}

/// Returns the names of the options of all commands, without dashes.
const std::vector<std::string>& option_keys() {
    static const std::vector<std::string> keys = [] {
        std::vector<std::string> all;
        for (const Command& command : commands()) {
            for (const Option& option : with_common(command)) all.push_back(option.key());
        }
        return all;
    }();
    return keys;
}

/// Prints the problems of an Error on stderr, one per line.
int fail(const Error& error) {
    const ExitCode code = exit_code(error);
    for (const std::string& line : split(error.what(), '\n')) {
        fail(code, in_option_words(line, option_keys()));
    }
    return code;
}

/// Returns eight lines. A test checks that they name every command.
std::string overview() {
    return "heddle " HEDDLE_VERSION ": yarn, hair and meshes to sparse anisotropic volumes\n"
           "usage: heddle COMMAND ... [--help]\n"
           "make:   generate (knit, weave, hair, grass, brushed plate), slice (image of a yarn's section), voxelize (a .vdb)\n"
           "look:   info (contents of a file), preview, view, render (pictures), lod-report (errors of levels)\n"
           "change: lod (levels of a .vdb), material (its materials), export (to Mitsuba)\n"
           "first:  heddle generate knit -o knit.bcc\n"
           "then:   heddle voxelize knit.bcc --yarn cotton -o knit.vdb\n"
           "and:    heddle preview knit.vdb -o knit.png\n";
}

void run_command(const Command& command, const std::vector<std::string>& words) {
    const Arguments arguments(
        parse_arguments(command, {words.begin() + 1, words.end()}, quote_line(words)));
    set_thread_count(static_cast<int>(arguments.integer("threads")));
    Report report;
    report.json = arguments.given("json");
    report.quiet = arguments.given("quiet");
    report.option_keys = option_keys();
    // on the heap and never freed: a late signal may still use it
    auto* bar = new ProgressBar(!report.quiet && ::isatty(STDERR_FILENO) == 1,
                                [&report](const std::string& note) { report.say(note); });
    cancel_on_signals(*bar);
    try {
        command.run(arguments, report, *bar);
    } catch (...) {
        bar->finish(); // the error's line is not written behind the bar
        throw;
    }
    bar->finish();
    report.print();
}

void run(const std::vector<std::string>& words) {
    if (words.empty() || words[0] == "--help" || words[0] == "-h" || words[0] == "help") {
        return print_out(overview());
    }
    if (words[0] == "--version") return print_out("heddle " HEDDLE_VERSION "\n");
    if (words[0] == "help-tables") return print_out(markdown_tables(commands()));
    std::vector<std::string> names;
    for (const Command& command : commands()) {
        if (command.name == words[0]) {
            return wants_help(words) ? print_out(help_text(command)) : run_command(command, words);
        }
        names.push_back(command.name);
    }
    const std::string_view near = nearest_name(words[0], names);
    throw UsageError(str("unknown command '", words[0], "'; ",
                         near.empty() ? "see heddle --help" : str("did you mean '", near, "'?")));
}

int guarded_run(const std::vector<std::string>& words) {
    try {
        run(words);
        return Ok;
    } catch (const UsageError& e) {
        return fail(Usage, e.what());
    } catch (const Error& e) {
        return fail(e);
    } catch (const std::bad_alloc&) {
        return fail(DeviceOrMemory, "out of memory; set --memory to less than the free memory");
    } catch (const std::exception& e) {
        return fail(Failed, str("internal error: ", e.what()));
    }
}

} // namespace
} // namespace heddle::cli

int main(int argc, char** argv) {
    return heddle::cli::guarded_run({argv + std::min(argc, 1), argv + argc});
}
