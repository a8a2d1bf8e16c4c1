#pragma once

namespace heddle::check {

/// Bytes read and written a second by a copy within the device's memory, GB/s; 0 without a device.
[[nodiscard]] double copy_bandwidth();

} // namespace heddle::check
