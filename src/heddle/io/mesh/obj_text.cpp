#include <heddle/io/mesh/obj_text.h>

#include <heddle/base/error.h>
#include <heddle/io/file/input_file.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>

namespace heddle {
namespace {

constexpr std::string_view kBlank = " \t";
constexpr int kMaxCorners = 4096; // triangulation takes time quadratic in the corners

std::string_view next_token(std::string_view& rest) {
    const std::size_t start = std::min(rest.find_first_not_of(kBlank), rest.size());
    rest.remove_prefix(start);
    const std::size_t size = std::min(rest.find_first_of(kBlank), rest.size());
    const std::string_view token = rest.substr(0, size);
    rest.remove_prefix(size);
    return token;
}

bool is_finite_number(std::string_view token) {
    if (!token.empty() && token.front() == '+') token.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    return error == std::errc{} && end == token.data() + token.size() &&
           std::abs(value) <= double{std::numeric_limits<float>::max()};
}

class ObjChecker {
public:
    explicit ObjChecker(std::string path) : path_(std::move(path)) {}

    /// True if the parser needs the statement, which may be changed.
    bool accept(std::span<char> statement, std::int64_t line) {
        line_ = line;
        std::string_view rest(statement.data(), statement.size());
        const std::string_view keyword = next_token(rest);
        if (keyword == "v") return check_numbers(rest, kPosition, 3);
        if (keyword == "vt") return check_numbers(rest, kUv, 1);
        if (keyword == "vn") return check_numbers(rest, kNormal, 3);
        if (keyword == "f" || keyword == "l") {
            if (keyword == "f")
                check_corners(rest, "face", 3);
            else
                check_corners(rest, "line", 2);
            blank_last_slashes(statement);
            return true;
        }
        if (keyword == "mtllib") {
            const std::size_t start = std::min(rest.find_first_not_of(kBlank), rest.size());
            libraries.emplace_back(rest.substr(start, rest.find_last_not_of(kBlank) + 1 - start));
        }
        return keyword == "usemtl";
    }

    /// Positive indices may refer to later lines: checked at the end of the file.
    void finish() {
        for (std::size_t kind = 0; kind < 3; ++kind) {
            if (largest_[kind].index <= count_[kind]) continue;
            line_ = largest_[kind].line;
            fail(str("names ", kNames[kind], " ", largest_[kind].index, " of ", count_[kind]));
        }
    }

    std::vector<std::string> libraries;

private:
    enum Kind : std::size_t { kPosition, kUv, kNormal };
    static constexpr std::array<const char*, 3> kNames{"vertex", "uv", "normal"};
    struct Largest {
        std::int64_t index = 0;
        std::int64_t line = 0;
    };

    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorCode::BadFile, what, "export the file again",
                    {.path = path_, .line = line_});
    }

    bool check_numbers(std::string_view rest, Kind kind, int needed) {
        ++count_[kind];
        for (int i = 0; i < needed; ++i) {
            const std::string_view token = next_token(rest);
            if (!is_finite_number(token))
                fail(str(kNames[kind], " ", count_[kind], " has '", token.substr(0, 40), "' where ",
                         "a finite number is needed"));
        }
        return true;
    }

    void check_corners(std::string_view rest, const char* what, int needed) {
        int corners = 0;
        for (std::string_view token = next_token(rest); !token.empty(); token = next_token(rest)) {
            check_corner(token, what);
            ++corners;
        }
        if (corners < needed || corners > kMaxCorners)
            fail(str("a ", what, " has ", corners, " corners, allowed are ", needed, " to ",
                     kMaxCorners));
    }

    /// Removes the slash of `1/` and `1/2/`: the parser would look for an index after it, and find
    /// that of the next corner.
    static void blank_last_slashes(std::span<char> statement) {
        for (std::size_t i = 0; i < statement.size(); ++i) {
            const bool last = i + 1 == statement.size() ||
                              kBlank.find(statement[i + 1]) != std::string_view::npos;
            if (statement[i] == '/' && last) statement[i] = ' ';
        }
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`
    void check_corner(std::string_view token, const char* what) {
        const char* at = token.data();
        const char* const end = at + token.size();
        for (std::size_t kind = 0; kind < 3; ++kind) {
            if (kind == kUv && at < end && *at == '/') {
                ++at;
                continue;
            }
            std::int64_t index = 0;
            const auto [stop, error] = std::from_chars(at, end, index);
            if (error != std::errc{} || index == 0 ||
                std::abs(index) > std::numeric_limits<std::int32_t>::max())
                fail(str("a ", what, " has the corner '", token.substr(0, 40), "', which names no ",
                         kNames[kind]));
            note_index(kind, index);
            if (stop == end) return;
            if (*stop != '/') break;
            at = stop + 1;
            if (at == end && kind != kNormal) return; // some files have `1/` and `1/2/`
        }
        fail(str("a ", what, " has the corner '", token.substr(0, 40), "', expected v/vt/vn"));
    }

    void note_index(std::size_t kind, std::int64_t index) {
        if (index < 0 && -index > count_[kind])
            fail(str("names ", kNames[kind], " ", index, ", and only ", count_[kind],
                     " come before it"));
        if (index > largest_[kind].index) largest_[kind] = {index, line_};
    }

    std::string path_;
    std::int64_t line_ = 0;
    std::array<std::int64_t, 3> count_{};
    std::array<Largest, 3> largest_{};
};

/// Makes every line break one '\n': "\r\n", and the single '\r' of old Macs, at which the parser
/// ends a line too. The checks and the parser then find the same lines.
void unify_line_ends(std::string& text) {
    std::size_t kept = std::min(text.find('\r'), text.size());
    for (std::size_t i = kept; i < text.size(); ++i) {
        const bool pair = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
        if (pair) ++i;
        text[kept++] = text[i] == '\r' ? '\n' : text[i];
    }
    text.resize(kept);
}

/// The end of the statement that begins at `start`; a backslash joins the next line to it.
std::size_t statement_end(std::string& text, std::size_t start, std::int64_t& line) {
    std::size_t end = start;
    while (true) {
        const std::size_t part = end;
        end = text.find('\n', part);
        ++line;
        if (end == part || text[end - 1] != '\\' || end + 1 == text.size()) return end;
        text[end - 1] = ' ';
        text[end++] = ' ';
    }
}

} // namespace

ObjText read_obj_text(const std::filesystem::path& path) {
    std::string text = read_whole_file(path.string(), kAnySize);
    text.push_back('\n'); // so that every statement ends with one
    if (const std::size_t zero = text.find('\0'); zero != std::string::npos)
        throw Error(ErrorCode::BadFile, "a zero byte stands in it, an .obj file is text",
                    "check what kind of file it is",
                    {.path = path.string(), .offset = static_cast<std::int64_t>(zero)});
    unify_line_ends(text);
    ObjChecker checker(path.string());
    std::size_t kept = 0; // statements that are kept move to the front
    std::int64_t line = 0;
    for (std::size_t start = 0; start < text.size();) {
        const std::int64_t first_line = line + 1;
        const std::size_t end = statement_end(text, start, line);
        if (checker.accept(std::span(text).subspan(start, end - start), first_line)) {
            std::memmove(text.data() + kept, text.data() + start, end - start);
            kept += end - start;
            text[kept++] = '\n';
        }
        start = end + 1;
    }
    checker.finish();
    text.resize(kept);
    return {std::move(text), std::move(checker.libraries)};
}

} // namespace heddle
