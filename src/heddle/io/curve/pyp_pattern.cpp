#include <heddle/io/curve/pyp_pattern.h>

#include <heddle/base/error.h>
#include <heddle/io/file/input_file.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

namespace heddle {
namespace {

constexpr std::size_t kColumns = 4; // of every section that is read

/// One row of numbers and its line.
struct Row {
    std::array<double, kColumns> value{};
    std::size_t count = 0;
    std::int64_t line = 0;
};

class PypParser {
public:
    explicit PypParser(const std::string& path) : path_(path), text_(read_whole_file(path)) {}

    PypPattern parse() {
        parse_sections();
        PypPattern pattern = make_pattern();
        for (const Row& row : edges_) add_edge(row, pattern);
        pattern.unknown_sections = std::move(unknown_);
        return pattern;
    }

private:
    [[noreturn]] void
    fail(std::int64_t line, const std::string& what, const std::string& fix = {}) const {
        throw Error(ErrorCode::BadFile, what, fix, {.path = path_, .line = line});
    }

    void parse_sections() {
        std::vector<Row>* section = nullptr; // nullptr: its rows are skipped
        std::int64_t line = 0;
        for (std::size_t at = 0; at < text_.size();) {
            ++line;
            const std::size_t end = std::min(text_.find('\n', at), text_.size());
            std::string_view row(text_.data() + at, end - at);
            at = end + 1;
            row = trim(row.substr(0, row.find('#')));
            if (row.empty()) continue;
            if (row.front() == '*') {
                section = open_section(trim(row.substr(1)));
            } else if (!any_section_) {
                fail(line, "is not a .pyp file: it does not start with '*pattern'",
                     "check the file's kind");
            } else if (section != nullptr) {
                section->push_back(parse_row(row, line));
            }
        }
    }

    std::vector<Row>* open_section(std::string_view name) {
        any_section_ = true;
        if (name == "pattern") return &header_;
        if (name == "Q") return &vertices_;
        if (name == "E") return &edges_;
        constexpr std::array<std::string_view, 5> kSimulation{"RL", "RK", "RT", "RefD1", "RefT"};
        if (std::find(kSimulation.begin(), kSimulation.end(), name) == kSimulation.end()) {
            unknown_.emplace_back(name.substr(0, 40));
        }
        return nullptr;
    }

    static std::string_view trim(std::string_view s) {
        constexpr std::string_view kSpace = " \t\r\v\f";
        const std::size_t begin = std::min(s.find_first_not_of(kSpace), s.size());
        s.remove_prefix(begin);
        return s.substr(0, s.find_last_not_of(kSpace) + 1);
    }

    [[nodiscard]] Row parse_row(std::string_view text, std::int64_t line) const {
        Row row;
        row.line = line;
        while (!text.empty()) {
            const std::string_view word = text.substr(0, text.find_first_of(" \t"));
            double value = 0.0;
            const auto [end, error] = std::from_chars(word.begin(), word.end(), value);
            if (error != std::errc{} || end != word.end() || !std::isfinite(value)) {
                fail(line, str("'", word.substr(0, 40), "' is not a finite number"));
            }
            if (row.count == kColumns) fail(line, str("has more than ", kColumns, " numbers"));
            row.value[row.count++] = value;
            text = trim(text.substr(word.size()));
        }
        if (row.count != kColumns) {
            fail(line, str("has ", row.count, " numbers, it must have ", kColumns));
        }
        return row;
    }

    [[nodiscard]] PypPattern make_pattern() const {
        if (header_.size() != 1) {
            fail(1, str("has ", header_.size(), " '*pattern' rows, it must have 1"));
        }
        const Row& h = header_.front();
        PypPattern p;
        p.px = h.value[0];
        p.py = h.value[1];
        p.radius = static_cast<float>(h.value[2]);
        if (!(p.px > 0.0) || !(p.py > 0.0)) {
            fail(h.line, str("period is ", p.px, " x ", p.py, ", both must be > 0"));
        }
        if (vertices_.empty() || edges_.empty()) {
            fail(h.line, str("holds no ", vertices_.empty() ? "vertices (*Q)" : "edges (*E)"));
        }
        if (static_cast<double>(vertices_.size()) != h.value[3]) {
            fail(h.line, str("names ", h.value[3], " vertices, *Q holds ", vertices_.size()));
        }
        for (const Row& row : vertices_) {
            p.vertices.push_back(to_float(Vec3d{row.value[0], row.value[1], row.value[2]}));
            const Vec3f v = p.vertices.back();
            if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
                fail(row.line, "vertex is too far away for 32-bit numbers");
            }
        }
        p.next.resize(p.vertices.size());
        p.previous.resize(p.vertices.size());
        return p;
    }

    [[nodiscard]] std::int64_t
    to_integer(const Row& row, std::size_t column, double lo, double hi, const char* what) const {
        const double v = row.value[column];
        if (!(v >= lo && v <= hi) || v != std::floor(v)) {
            fail(row.line,
                 str(what, " is ", v, ", it must be a whole number from ", lo, " to ", hi));
        }
        return static_cast<std::int64_t>(v);
    }

    void add_edge(const Row& row, PypPattern& p) const {
        const double last = static_cast<double>(p.vertices.size() - 1);
        constexpr double kFar = 1e6; // tiles; sums of steps cannot overflow 64 bits
        const std::int64_t a = to_integer(row, 0, 0.0, last, "vertex");
        const std::int64_t b = to_integer(row, 1, 0.0, last, "vertex");
        const std::int64_t dx = to_integer(row, 2, -kFar, kFar, "tile step");
        const std::int64_t dy = to_integer(row, 3, -kFar, kFar, "tile step");
        PypStep& next = p.next[static_cast<std::size_t>(a)];
        PypStep& previous = p.previous[static_cast<std::size_t>(b)];
        if (next.vertex != -1 || previous.vertex != -1) {
            fail(row.line, str("vertex ", next.vertex != -1 ? a : b,
                               next.vertex != -1 ? " has two ways on" : " has two ways to it",
                               ", a yarn has one"));
        }
        if (a == b && dx == 0 && dy == 0) fail(row.line, str("vertex ", a, " leads to itself"));
        next = {b, dx, dy};
        previous = {a, -dx, -dy};
    }

    std::string path_;
    std::string text_;
    std::vector<Row> header_;
    std::vector<Row> vertices_;
    std::vector<Row> edges_;
    std::vector<std::string> unknown_;
    bool any_section_ = false;
};

} // namespace

PypPattern parse_pyp_pattern(const std::string& path) {
    return PypParser(path).parse();
}

} // namespace heddle
