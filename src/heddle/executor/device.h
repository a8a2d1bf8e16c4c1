#pragma once

#include <cstdint>
#include <string>

namespace heddle::executor {

/// The CUDA device that executors use.
struct Device {
    std::string name;            ///< empty: there is no device
    std::string why;             ///< why there is none, in words
    std::int64_t free_bytes = 0; ///< free memory of the device now
};

/// Looks for a device and makes its memory pool keep the memory it has taken. Never throws: if
/// there is no device or driver, or the build is without CUDA, `why` says so.
[[nodiscard]] Device find_device();

} // namespace heddle::executor
