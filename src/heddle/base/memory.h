#pragma once

#include <cstdint>

namespace heddle {

/// Peak resident size of this process so far, in bytes (Linux VmHWM); 0 if unknown.
[[nodiscard]] std::int64_t peak_resident_bytes();

/// Memory that can be allocated now without swapping, in bytes (Linux MemAvailable); 0 if unknown.
[[nodiscard]] std::int64_t available_bytes();

} // namespace heddle
