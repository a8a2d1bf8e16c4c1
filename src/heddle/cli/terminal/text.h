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

/// "heddle" and the words as a shell would take them back.
[[nodiscard]] std::string quote_line(const std::vector<std::string>& words);

} // namespace heddle::cli
