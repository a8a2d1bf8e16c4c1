#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace heddle::cli {

/// Converts a decimal integer; nothing if `text` is anything else or does not fit.
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view text);

/// Converts a finite number; nothing if `text` is anything else.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// Converts "4G", "1500M", "1.5GiB" or "65536" to bytes: K, M, G and T are powers of 1024.
/// @return  >= 1; nothing if `text` is anything else
[[nodiscard]] std::optional<std::int64_t> parse_bytes(std::string_view text);

/// Splits a text at separators: "1,2" gives "1" and "2".
[[nodiscard]] std::vector<std::string> split(std::string_view text, char separator);

/// Returns "heddle" and the words, quoted so that a shell reads the same words.
[[nodiscard]] std::string quote_line(const std::vector<std::string>& words);

} // namespace heddle::cli
