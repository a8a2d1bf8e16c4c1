#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace heddle::cli {

enum class ValueKind : std::uint8_t {
    Flag,    ///< no value
    Text,    ///< any
    Choice,  ///< one of `words`
    Integer, ///< in [lo, hi]
    Numbers, ///< least to most finite numbers in [lo, hi], joined by `separator`
    Bytes    ///< 4G, 1500M
};

/// The values that an option allows. Parsing, checking and help texts use nothing else.
struct ValueRule {
    ValueKind kind = ValueKind::Text;
    std::vector<std::string> words{};
    double lo = 0.0, hi = 0.0;
    bool above = false; ///< lo itself is not allowed
    int least = 1, most = 1;
    char separator = ',';

    /// Returns the range in words, such as "1 to 8" or "columns or mask"; empty: anything is
    /// allowed.
    [[nodiscard]] std::string range() const;
    /// Returns what is wrong with a value, such as "'x' is not ..."; empty: nothing is.
    [[nodiscard]] std::string problem(const std::string& text) const;
};

[[nodiscard]] ValueRule flag();
[[nodiscard]] ValueRule any_text();
[[nodiscard]] ValueRule one_of(std::vector<std::string> words);
[[nodiscard]] ValueRule integer(std::int64_t lo, std::int64_t hi);
[[nodiscard]] ValueRule number(double lo, double hi);
[[nodiscard]] ValueRule positive();
/// `least` or `most` numbers, joined by `separator`.
[[nodiscard]] ValueRule
numbers(int least, int most, double lo, double hi, char separator = ',', bool above = false);
[[nodiscard]] ValueRule bytes();

} // namespace heddle::cli
