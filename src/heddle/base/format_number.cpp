#include <heddle/base/format_number.h>

#include <heddle/base/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace heddle {
namespace {

/// `value` with three significant digits, then the unit.
std::string three_digits(double value, std::string_view unit) {
    std::array<char, 32> out{};
    const double size = std::abs(value);
    const int decimals = size >= 99.95 ? 0 : size >= 9.995 ? 1 : 2;
    std::snprintf(out.data(), out.size(), "%.*f ", decimals, value);
    return std::string(out.data()).append(unit);
}

} // namespace

std::string format_count(double count) {
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

std::string format_fixed(double value, int decimals) {
    std::array<char, 400> out{}; // the largest double has 309 digits
    std::snprintf(out.data(), out.size(), "%.*f", std::clamp(decimals, 0, 20), value);
    return out.data();
}

std::string format_bytes(double bytes) {
    if (bytes < 1024.0) return str(static_cast<std::int64_t>(bytes), " B");
    constexpr std::array<const char*, 5> kUnits{"B", "KiB", "MiB", "GiB", "TiB"};
    std::size_t unit = 0;
    for (; bytes >= 1023.5 && unit + 1 < kUnits.size(); ++unit) bytes /= 1024.0;
    return three_digits(bytes, kUnits[unit]);
}

std::string format_seconds(double seconds) {
    if (seconds < 99.95) return three_digits(seconds, "s");
    const auto whole = static_cast<std::int64_t>(std::llround(seconds));
    if (whole < 3600) return str(whole / 60, " min ", whole % 60, " s");
    return str(whole / 3600, " h ", whole % 3600 / 60, " min");
}

} // namespace heddle
