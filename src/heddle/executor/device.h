#pragma once

#include <cstdint>
#include <string>

namespace heddle::executor {

/// The CUDA device that executors use.
struct Device {
    std::string name;            ///< empty: there is none
    std::string why;             ///< if there is none: the reason, in words
    std::int64_t free_bytes = 0; ///< of its memory, now
};

/// Looks for a device; makes its memory pool keep what it has taken. Never throws: no device, no driver
/// and a build without CUDA are answers.
[[nodiscard]] Device find_device();

} // namespace heddle::executor
