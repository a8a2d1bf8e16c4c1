#pragma once

namespace heddle::check {

/// Bytes read and written a second by a copy within the device's memory, GB/s; 0 without a device.
[[nodiscard]] double copy_bandwidth();

/// Single-precision operations a second of all lanes, without contraction, 1e9 / s; 0 without a device.
[[nodiscard]] double peak_gigaflops();

} // namespace heddle::check
