#pragma once

#include <cstdint>
#include <string>

namespace heddle {

/// "12.4 M" for 12,400,000; whole numbers below 1000 as they are.
[[nodiscard]] std::string format_count(double count);

/// "0.125": so many digits behind the point.
[[nodiscard]] std::string format_fixed(double value, int decimals);

/// "1.8 GiB" for 1,932,735,283.
[[nodiscard]] std::string format_bytes(double bytes);

/// "0.42 s", "12.3 s", "3 min 20 s", "2 h 5 min".
[[nodiscard]] std::string format_seconds(double seconds);

} // namespace heddle
