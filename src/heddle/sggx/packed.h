#pragma once

#include <heddle/sggx/sggx.h>

#include <cstdint>

namespace heddle {

/// An SGGX in 6 bytes: sigma_x sigma_y sigma_z (0..255 for 0..1), then r_xy r_xz r_yz, each as an
/// angle: r = -cos(pi byte / 254), byte 0..254. [Fabre26, eq. 17]
struct PackedSggx {
    std::uint8_t sigma[3]{};
    std::uint8_t r[3]{};
    friend bool operator==(const PackedSggx&, const PackedSggx&) = default;
};
static_assert(sizeof(PackedSggx) == 6, "six bytes in files");

} // namespace heddle
