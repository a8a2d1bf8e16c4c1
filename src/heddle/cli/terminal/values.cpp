#include <heddle/base/error.h>
#include <heddle/base/nearest_name.h>
#include <heddle/cli/terminal/text.h>
#include <heddle/cli/terminal/values.h>

#include <algorithm>
#include <limits>

namespace heddle::cli {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

std::string join(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
        text += words[i];
    }
    return text;
}

std::string interval(double lo, double hi, bool above) {
    const auto plain = [](double x) {
        return std::abs(x) < 1e15 && x == static_cast<double>(static_cast<std::int64_t>(x))
                   ? str(static_cast<std::int64_t>(x))
                   : str(x);
    };
    if (lo == -kInf && hi == kInf) return {};
    if (lo == -kInf) return str("<= ", plain(hi));
    if (hi == kInf) return str(above ? "> " : ">= ", plain(lo));
    return str(above ? "> " : "", plain(lo), " to ", plain(hi));
}

bool inside(double x, const ValueRule& v) {
    return (v.above ? x > v.lo : x >= v.lo) && x <= v.hi;
}

std::string numbers_problem(const std::string& text, const ValueRule& v) {
    const std::vector<std::string> pieces = split(text, v.separator);
    const int n = static_cast<int>(pieces.size());
    if (n != v.least && n != v.most) {
        return str("'", text, "' has ", n, n == 1 ? " number" : " numbers", "; expected ", v.least,
                   v.most > v.least ? str(" or ", v.most) : "", ", separated by '", v.separator,
                   "'");
    }
    for (const std::string& piece : pieces) {
        const std::optional<double> x = parse_number(piece);
        if (!x) return str("'", piece, "' is not a number");
        if (!inside(*x, v)) {
            return str(piece, " is out of range; it must be ", interval(v.lo, v.hi, v.above));
        }
    }
    return {};
}

} // namespace

std::string ValueRule::range() const {
    switch (kind) {
    case ValueKind::Choice: return join(words);
    case ValueKind::Integer:
    case ValueKind::Numbers: return interval(lo, hi, above);
    case ValueKind::Flag:
    case ValueKind::Text:
    case ValueKind::Bytes: return {};
    }
    return {};
}

std::string ValueRule::problem(const std::string& text) const {
    switch (kind) {
    case ValueKind::Choice: {
        if (std::find(words.begin(), words.end(), text) != words.end()) return {};
        const std::string_view near = nearest_name(text, words);
        return str("'", text, "' is not one of ", join(words),
                   near.empty() ? "" : str("; did you mean '", near, "'?"));
    }
    case ValueKind::Integer: {
        const std::optional<std::int64_t> n = parse_integer(text);
        if (!n) return str("'", text, "' is not a whole number");
        if (inside(static_cast<double>(*n), *this)) return {};
        return str(text, " is out of range; it must be ", range());
    }
    case ValueKind::Numbers: return numbers_problem(text, *this);
    case ValueKind::Bytes:
        return parse_bytes(text) ? ""
                                 : str("'", text, "' is not a size; write for example 4G or 1500M");
    case ValueKind::Text: return text.empty() ? "the value is empty" : "";
    case ValueKind::Flag: return {};
    }
    return {};
}

ValueRule flag() {
    return {.kind = ValueKind::Flag};
}
ValueRule any_text() {
    return {.kind = ValueKind::Text};
}
ValueRule one_of(std::vector<std::string> words) {
    return {.kind = ValueKind::Choice, .words = std::move(words)};
}
ValueRule integer(std::int64_t lo, std::int64_t hi) {
    return {
        .kind = ValueKind::Integer, .lo = static_cast<double>(lo), .hi = static_cast<double>(hi)};
}
ValueRule number(double lo, double hi) {
    return {.kind = ValueKind::Numbers, .lo = lo, .hi = hi};
}
ValueRule positive() {
    return {.kind = ValueKind::Numbers, .lo = 0.0, .hi = kInf, .above = true};
}
ValueRule numbers(int least, int most, double lo, double hi, char separator, bool above) {
    return {.kind = ValueKind::Numbers,
            .lo = lo,
            .hi = hi,
            .above = above,
            .least = least,
            .most = most,
            .separator = separator};
}
ValueRule bytes() {
    return {.kind = ValueKind::Bytes};
}

} // namespace heddle::cli
