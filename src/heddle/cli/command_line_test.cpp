#include <heddle/cli/commands.h>
#include <heddle/cli/terminal/command_line.h>
#include <heddle/cli/terminal/help_text.h>

#include <gtest/gtest.h>

#include <set>
#include <sstream>

namespace heddle::cli {
namespace {

Arguments parse(const std::vector<std::string>& words) {
    return parse_arguments(voxelize_command(), words, "heddle voxelize");
}

std::string usage_error(const std::vector<std::string>& words) {
    try {
        static_cast<void>(parse(words));
    } catch (const UsageError& e) {
        return e.what();
    }
    return "no error";
}

TEST(CommandLine, GivenValuesAndPresetsAreTold) {
    const Arguments a = parse({"in.bcc", "-o", "x.vdb", "--voxel-size", "1,2,3", "--memory=4G"});
    EXPECT_EQ(a.text("FILE"), "in.bcc");
    EXPECT_EQ(a.text("output"), "x.vdb");
    EXPECT_EQ(a.numbers("voxel-size"), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(a.bytes("memory"), std::int64_t{4} << 30);
    EXPECT_FALSE(a.given("voxels"));
    EXPECT_EQ(a.integer("voxels"), 512);
    EXPECT_FALSE(a.given("dry-run"));
}

TEST(CommandLine, AnOptionThatRepeatsKeepsItsValuesInOrder) {
    const Arguments a =
        parse_arguments(material_command(), {"x.vdb", "--set", "b.alpha=1", "--set", "a.name=2"},
                        "heddle material");
    EXPECT_EQ(a.texts("set"), (std::vector<std::string>{"b.alpha=1", "a.name=2"}));
    EXPECT_EQ(a.texts("output"), std::vector<std::string>{});
    EXPECT_NE(help_text(material_command()).find("can be repeated"), std::string::npos);
}

TEST(CommandLine, NegativeNumbersAreValues) {
    const Arguments a = parse({"in.bcc", "-o", "x.vdb", "--bounds", "-1,-2,-3,1,2,3"});
    EXPECT_EQ(a.numbers("bounds").front(), -1.0);
}

TEST(CommandLine, WrongWordsAreNamedWithWhatWouldBeRight) {
    const std::vector<std::string> ok{"in.bcc", "-o", "x.vdb"};
    const auto with = [&ok](const std::vector<std::string>& more) {
        std::vector<std::string> words = ok;
        words.insert(words.end(), more.begin(), more.end());
        return usage_error(words);
    };
    EXPECT_EQ(with({"--voxles", "5"}), "unknown option '--voxles'; did you mean '--voxels'?");
    EXPECT_EQ(with({"--lobes", "9"}), "--lobes: 9 is out of range; it must be 1 to 8");
    EXPECT_EQ(with({"--lobes", "two"}), "--lobes: 'two' is not a whole number");
    EXPECT_EQ(with({"--lobes", "1", "--lobes", "2"}), "--lobes is given 2 times; give it once");
    EXPECT_EQ(with({"--fit", "lst"}),
              "--fit: 'lst' is not one of moments or last; did you mean 'last'?");
    EXPECT_EQ(with({"--voxel-size", "0"}), "--voxel-size: 0 is out of range; it must be > 0");
    EXPECT_EQ(with({"--voxel-size", "nan"}), "--voxel-size: 'nan' is not a number");
    EXPECT_EQ(with({"--voxel-size", "1,2"}),
              "--voxel-size: '1,2' has 2 numbers; expected 1 or 3, separated by ','");
    EXPECT_EQ(with({"--memory", "lots"}),
              "--memory: 'lots' is not a size; write for example 4G or 1500M");
    EXPECT_EQ(with({"more.bcc"}), "unexpected argument 'more.bcc'; see heddle voxelize --help");
    EXPECT_EQ(usage_error({"in.bcc"}), "option --output is missing; see heddle voxelize --help");
    EXPECT_EQ(usage_error({"-o", "x.vdb"}), "FILE is missing; see heddle voxelize --help");
    EXPECT_NE(with({"--voxels"}), "no error");
}

TEST(CommandLine, EveryPresetIsAValueThatItsOwnRowAllows) {
    for (const Command& command : commands()) {
        std::vector<Option> options = command.options;
        options.insert(options.end(), common_rows().begin(), common_rows().end());
        std::set<std::string> keys;
        for (const Option& option : options) {
            EXPECT_TRUE(keys.insert(option.key()).second) << command.name << " " << option.key();
            EXPECT_FALSE(option.text.empty()) << command.name << " " << option.names;
            if (option.preset.empty() || option.preset.front() == '(') continue;
            EXPECT_EQ(option.values.problem(option.preset), "") << command.name << option.names;
        }
    }
}

TEST(CommandLine, HelpHasEachRowUnderTheHeadingOfItsGroup) {
    for (const Command& command : commands()) {
        std::vector<Option> options = command.options;
        options.insert(options.end(), common_rows().begin(), common_rows().end());
        const std::string text = help_text(command);
        std::size_t line = 0, heading = 0;
        std::string group;
        for (const Option& option : options) {
            ASSERT_FALSE(option.group.empty()) << command.name << " " << option.names;
            if (option.group != group) {
                group = option.group;
                const std::string words = "\n\n" + group + ":\n";
                heading = text.find(words);
                ASSERT_NE(heading, std::string::npos) << command.name << " " << group;
                EXPECT_GT(heading, line) << command.name << " " << group;
                EXPECT_EQ(text.find(words, heading + 1), std::string::npos) << group;
            }
            line = text.find("\n  " + option.names, heading);
            ASSERT_NE(line, std::string::npos) << command.name << " " << option.names;
            EXPECT_EQ(text.substr(heading + 2, line - heading - 2).find("\n\n"), std::string::npos)
                << command.name << " " << option.names << " is not under " << group;
        }
    }
}

TEST(CommandLine, HelpIsAtMostAHundredColumnsWide) {
    for (const Command& command : commands()) {
        std::istringstream lines(help_text(command));
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with("usage:") || line == command.summary) continue;
            EXPECT_LE(line.size(), 100u) << command.name << ": " << line;
        }
    }
}

TEST(CommandLine, JoinedListsHaveEachGroupInOnePiece) {
    const auto row = [](const std::string& name) {
        return Option{name, "", "", flag(), "", "Does something."};
    };
    const std::vector<Option> rows =
        joined({grouped("a", {row("--one")}), grouped("b", {row("--two")}),
                grouped("a", {row("--three")})});
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0].names, "--one");
    EXPECT_EQ(rows[1].names, "--three");
    EXPECT_EQ(rows[2].names, "--two");
    EXPECT_EQ(rows[1].group, "a");
}

TEST(CommandLine, TextsAreSentences) {
    for (const Command& command : commands()) {
        std::vector<Option> options = command.options;
        options.insert(options.end(), common_rows().begin(), common_rows().end());
        for (const Option& option : options) {
            EXPECT_TRUE(option.text.ends_with('.')) << command.name << " " << option.names;
        }
        EXPECT_TRUE(command.summary.ends_with('.')) << command.name;
    }
}

TEST(CommandLine, HelpHasALineForEveryOption) {
    const std::string text = help_text(voxelize_command());
    for (const Option& option : voxelize_command().options) {
        EXPECT_NE(text.find("\n  " + option.names), std::string::npos) << option.names;
    }
    EXPECT_NE(text.find("--threads"), std::string::npos);
}

} // namespace
} // namespace heddle::cli
