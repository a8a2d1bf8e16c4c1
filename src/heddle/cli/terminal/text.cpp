#include <heddle/cli/terminal/text.h>

#include <charconv>
#include <cmath>

namespace heddle::cli {
namespace {

template <typename T>
std::optional<T> parse_whole(std::string_view text) {
    T value{};
    const char* end = text.data() + text.size();
    const auto [stop, status] = std::from_chars(text.data(), end, value);
    if (status != std::errc{} || stop != end) return std::nullopt;
    return value;
}

} // namespace

std::optional<std::int64_t> parse_integer(std::string_view text) {
    return parse_whole<std::int64_t>(text);
}

std::optional<double> parse_number(std::string_view text) {
    const std::optional<double> value = parse_whole<double>(text);
    if (value && !std::isfinite(*value)) return std::nullopt;
    return value;
}

std::optional<std::int64_t> parse_bytes(std::string_view text) {
    for (const std::string_view tail : {"iB", "B"}) {
        if (text.size() > tail.size() && text.ends_with(tail)) {
            text.remove_suffix(tail.size());
            break;
        }
    }
    double scale = 1.0;
    constexpr std::string_view kSuffixes = "KMGT";
    if (const auto at = text.empty() ? std::string_view::npos : kSuffixes.find(text.back());
        at != std::string_view::npos) {
        scale = std::exp2(10.0 * static_cast<double>(at + 1));
        text.remove_suffix(1);
    }
    const std::optional<double> value = parse_number(text);
    if (!value || !(*value * scale >= 1.0) || *value * scale > 0x1p62) return std::nullopt;
    return static_cast<std::int64_t>(*value * scale);
}

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> pieces;
    while (true) {
        const std::size_t at = text.find(separator);
        pieces.emplace_back(text.substr(0, at));
        if (at == std::string_view::npos) return pieces;
        text.remove_prefix(at + 1);
    }
}

std::string quote_line(const std::vector<std::string>& words) {
    constexpr std::string_view kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
        "-_./,=:+@%";
    std::string line = "heddle";
    for (const std::string& word : words) {
        line += ' ';
        if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
            line += word;
            continue;
        }
        line += '\'';
        for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
        line += '\'';
    }
    return line;
}

} // namespace heddle::cli
