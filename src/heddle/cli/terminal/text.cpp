#include <heddle/base/error.h>
#include <heddle/cli/terminal/text.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

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

/// `value` with three significant digits, then the unit.
std::string three_digits(double value, std::string_view unit) {
    std::array<char, 32> out{};
    const double size = std::abs(value);
    const int decimals = size >= 99.95 ? 0 : size >= 9.995 ? 1 : 2;
    std::snprintf(out.data(), out.size(), "%.*f ", decimals, value);
    return std::string(out.data()).append(unit);
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

std::string show_count(double count) {
    if (std::abs(count) < 1000.0 && count == std::floor(count)) {
        return str(static_cast<std::int64_t>(count));
    }
    constexpr std::array<const char*, 5> kUnits{"", "k", "M", "G", "T"};
    std::size_t unit = 0;
    for (; std::abs(count) >= 999.5 && unit + 1 < kUnits.size(); ++unit) count /= 1000.0;
    std::string text = three_digits(count, kUnits[unit]);
    if (text.back() == ' ') text.pop_back();
    return text;
}

std::string show_fixed(double value, int decimals) {
    std::array<char, 400> out{}; // the largest double has 309 digits
    std::snprintf(out.data(), out.size(), "%.*f", std::clamp(decimals, 0, 20), value);
    return out.data();
}

std::string show_bytes(double bytes) {
    if (bytes < 1024.0) return str(static_cast<std::int64_t>(bytes), " B");
    constexpr std::array<const char*, 5> kUnits{"B", "KiB", "MiB", "GiB", "TiB"};
    std::size_t unit = 0;
    for (; bytes >= 1023.5 && unit + 1 < kUnits.size(); ++unit) bytes /= 1024.0;
    return three_digits(bytes, kUnits[unit]);
}

std::string show_seconds(double seconds) {
    if (seconds < 99.95) return three_digits(seconds, "s");
    const auto whole = static_cast<std::int64_t>(std::llround(seconds));
    if (whole < 3600) return str(whole / 60, " min ", whole % 60, " s");
    return str(whole / 3600, " h ", whole % 3600 / 60, " min");
}

} // namespace heddle::cli
