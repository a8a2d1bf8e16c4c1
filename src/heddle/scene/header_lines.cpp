#include <heddle/scene/header_lines.h>

#include <heddle/base/error.h>

#include <cctype>
#include <map>

namespace heddle::scene_form {
namespace {

constexpr std::string_view kBom = "\xEF\xBB\xBF";

std::string_view trim_front(std::string_view s) {
    while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
    return s;
}

/// Whether toml++ can be handed what follows a header's brackets.
bool may_follow_bracket(char c) {
    const bool bare = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
    return bare || c == '"' || c == '\'' || c == ']';
}

/// The name in "[name]" without blanks; empty for anything else, rows of numbers among it.
std::string table_name(std::string_view line) {
    const std::size_t end = line.find(']');
    if (line.size() < 2 || line[1] == '[' || end == std::string_view::npos) return {};
    std::string name;
    for (const char c : line.substr(1, end - 1)) {
        if (c == ',') return {};
        if (c != ' ' && c != '\t') name += c;
    }
    const bool named = !name.empty() && (name[0] == '"' || name[0] == '\'' || name[0] == '_' ||
                                         std::isalpha(static_cast<unsigned char>(name[0])) != 0);
    return named ? name : std::string();
}

} // namespace

bool check_header_lines(std::string_view text, const std::string& path, Problems& problems) {
    bool good = true;
    std::map<std::string, std::int64_t> first;
    if (text.substr(0, kBom.size()) == kBom) text.remove_prefix(kBom.size());
    for (std::int64_t n = 1; !text.empty(); ++n) {
        const std::size_t end = text.find('\n');
        const std::string_view line = trim_front(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (line.empty() || line[0] != '[') continue;
        const bool twice = line.size() > 1 && line[1] == '[';
        const std::string_view inside = trim_front(line.substr(twice ? 2 : 1));
        if (inside.empty() || !may_follow_bracket(inside[0])) {
            problems.add({path, n}, "no name follows the bracket",
                         "write [name]; keep a list on the line of its key");
            good = false;
        }
        const std::string name = table_name(line);
        if (name.empty()) continue;
        const auto [at, fresh] = first.emplace(name, n);
        if (!fresh) {
            problems.add({path, n},
                         str("[", name, "] is defined at ", path, ":", at->second, " already"),
                         "drop or rename one of them");
            good = false;
        }
    }
    return good;
}

} // namespace heddle::scene_form
