#define TOML_IMPLEMENTATION // of toml++
#include <heddle/io/file/toml_text.h>

#include <heddle/base/error.h>

#include <algorithm>
#include <cctype>
#include <map>

namespace heddle {
namespace {

constexpr std::string_view kBom = "\xEF\xBB\xBF";

std::string_view trim_front(std::string_view s) {
    while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
    return s;
}

bool is_letter_or_quote(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '"' || c == '\'';
}

/// True if toml++ can parse this character after the bracket of a header.
bool may_follow_bracket(char c) {
    return is_letter_or_quote(c) || std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '-' ||
           c == ']';
}

/// The name in "[name]" without blanks; empty for "[[name]]".
std::string table_name(std::string_view line) {
    const std::size_t end = line.find(']');
    if (line.size() < 2 || line[1] == '[' || end == std::string_view::npos) return {};
    std::string name(line.substr(1, end - 1));
    std::erase_if(name, [](char c) { return c == ' ' || c == '\t'; });
    return name;
}

/// Scans the text as TOML. After an error in the text the scan may be wrong, but not before; toml++
/// stops at the first error, so all that it reads was scanned correctly.
class Walk {
public:
    Walk(std::string_view text, const std::string& path, Problems& problems)
        : text_(text), path_(path), problems_(problems) {}

    bool check() {
        if (text_.substr(0, kBom.size()) == kBom) at_ = kBom.size();
        while (good_ && at_ < text_.size()) {
            if (line_begins_) begin_line();
            if (at_ < text_.size()) step(text_[at_]);
        }
        return good_ && !twice_;
    }

private:
    void fail(const std::string& what, const std::string& fix) {
        problems_.add({path_, line_}, what, fix);
        good_ = false;
    }

    void begin_line() {
        line_begins_ = false;
        in_header_ = false;
        at_ = text_.size() - trim_front(text_.substr(at_)).size();
        if (open_.empty() && at_ < text_.size() && text_[at_] == '[') check_header();
    }

    void check_header() {
        in_header_ = true;
        const std::string_view line = text_.substr(at_, text_.find('\n', at_) - at_);
        const bool array = line.size() > 1 && line[1] == '[';
        const std::string_view inside = trim_front(line.substr(array ? 2 : 1));
        if (inside.empty() || !may_follow_bracket(inside[0])) {
            return fail("no name follows the bracket", "write [name]");
        }
        const std::string name = table_name(line);
        if (name.empty()) return;
        const auto [at, fresh] = first_.emplace(name, line_);
        if (fresh) return;
        problems_.add({path_, line_},
                      str("[", name, "] is defined at ", path_, ":", at->second, " already"),
                      "drop or rename one of them");
        twice_ = true;
    }

    void step(char c) {
        ++at_;
        if (c == '\n') {
            ++line_;
            line_begins_ = true;
        } else if (c == '#') {
            at_ = std::min(text_.find('\n', at_), text_.size());
        } else if (c == '"' || c == '\'') {
            skip_text(c);
        } else if (static_cast<unsigned char>(c) >= 0x80) {
            fail("a letter that is not ASCII stands outside of quotes", "put quotes around it");
        } else if (!in_header_) {
            bracket(c);
        }
    }

    void bracket(char c) {
        if (c == '[' || c == '{') open_ += c;
        if (c != ']' && c != '}') return;
        if (open_.empty() || open_.back() != (c == ']' ? '[' : '{')) {
            return fail(str("'", c, "' closes nothing that is open"), "pair the brackets");
        }
        open_.pop_back();
    }

    /// Moves from after an opening quote to after the closing one, or to the end of the line if
    /// that is missing.
    void skip_text(char quote) {
        const std::string triple(3, quote);
        const bool lines = text_.substr(at_ - 1, 3) == triple;
        if (lines) at_ += 2;
        for (; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (c == '\n' && !lines) return;
            if (c == '\n') ++line_;
            if (c == '\\' && quote == '"' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n')
                ++at_;
            if (c != quote || (lines && text_.substr(at_, 3) != triple)) continue;
            at_ += lines ? 3 : 1;
            while (lines && at_ < text_.size() && text_[at_] == quote) ++at_; // part of the text
            return;
        }
    }

    std::string_view text_;
    const std::string& path_;
    Problems& problems_;
    std::size_t at_ = 0;
    std::int64_t line_ = 1;
    std::string open_; ///< the open brackets of values
    bool line_begins_ = true;
    bool in_header_ = false;
    bool good_ = true;
    bool twice_ = false;
    std::map<std::string, std::int64_t> first_; ///< the line of each table
};

} // namespace

std::optional<toml::table>
parse_toml(std::string_view text, const std::string& path, Problems& problems) {
    if (!Walk(text, path, problems).check()) return std::nullopt;
    try {
        return toml::parse(text, path);
    } catch (const toml::parse_error& e) {
        problems.add({path, static_cast<std::int64_t>(e.source().begin.line)},
                     str("is no TOML: ", e.description()), "correct it");
        return std::nullopt;
    }
}

} // namespace heddle
