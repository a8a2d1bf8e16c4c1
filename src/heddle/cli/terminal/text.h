#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace heddle::cli {

/// The whole of `text` as a decimal integer; nothing if it is anything else, or does not fit.
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view text);

/// The whole of `text` as a finite number; nothing if it is anything else.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// Bytes from "4G", "1500M", "1.5GiB" or "65536": suffixes K, M, G, T are powers of 1024.
/// @return  >= 1; nothing if `text` is anything else
[[nodiscard]] std::optional<std::int64_t> parse_bytes(std::string_view text);

/// The pieces of `text` between separators: "1,2" gives "1" and "2".
[[nodiscard]] std::vector<std::string> split(std::string_view text, char separator);

/// "12.4 M" for 12,400,000; whole numbers below 1000 as they are.
[[nodiscard]] std::string show_count(double count);

/// "0.125": so many digits behind the point.
[[nodiscard]] std::string show_fixed(double value, int decimals);

/// "1.8 GiB" for 1,932,735,283.
[[nodiscard]] std::string show_bytes(double bytes);

/// "0.42 s", "12.3 s", "3 min 20 s", "2 h 5 min".
[[nodiscard]] std::string show_seconds(double seconds);

} // namespace heddle::cli
