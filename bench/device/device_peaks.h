#pragma once

namespace heddle::check {

/// Bytes read and written per second by a copy in the device's memory, GB/s; 0 without a device.
[[nodiscard]] double copy_bandwidth();

/// Single-precision operations per second of all lanes, uncontracted, 1e9 / s; 0 without a device.
[[nodiscard]] double peak_gigaflops();

} // namespace heddle::check
