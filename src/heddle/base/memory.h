#pragma once

#include <cstdint>

namespace heddle {

/// Largest resident size of this process so far, in bytes (Linux VmHWM); 0 where it is not known.
[[nodiscard]] std::int64_t peak_resident_bytes();

/// Memory that could be taken now without swapping, in bytes (Linux MemAvailable); 0 if not known.
[[nodiscard]] std::int64_t available_bytes();

} // namespace heddle
