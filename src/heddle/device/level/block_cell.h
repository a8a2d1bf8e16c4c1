#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>
#include <heddle/voxel/lattice_units.h>

#include <cstdint>

namespace heddle {

/// Number of voxels of a block.
constexpr std::uint32_t kVoxelsPerBlock = kBlockVoxels * kBlockVoxels * kBlockVoxels;

/// Returns bits b4 .. b0 of a coordinate as b4 00 b3 00 .. b0.
[[nodiscard]] HEDDLE_HD constexpr std::uint32_t spread_bits(std::uint32_t b) {
    b = (b | b << 8) & 0x100fu;
    b = (b | b << 4) & 0x10c3u;
    return (b | b << 2) & 0x1249u;
}
/// The inverse of spread_bits(); other bits are ignored.
[[nodiscard]] HEDDLE_HD constexpr std::uint32_t gather_bits(std::uint32_t b) {
    b &= 0x1249u;
    b = (b | b >> 2) & 0x10c3u;
    b = (b | b >> 4) & 0x100fu;
    return (b | b >> 8) & 0x1fu;
}

/// Returns the position of voxel (x, y, z) of a block in Z-order, bits of x first. The children of
/// a voxel are consecutive, in the order of child numbers x << 2 | y << 1 | z.
[[nodiscard]] HEDDLE_HD constexpr std::uint32_t z_order_from_index(Vec3i at) {
    return spread_bits(static_cast<std::uint32_t>(at.x)) << 2 |
           spread_bits(static_cast<std::uint32_t>(at.y)) << 1 |
           spread_bits(static_cast<std::uint32_t>(at.z));
}
[[nodiscard]] HEDDLE_HD constexpr Vec3i index_from_z_order(std::uint32_t z_order) {
    return {static_cast<std::int32_t>(gather_bits(z_order >> 2)),
            static_cast<std::int32_t>(gather_bits(z_order >> 1)),
            static_cast<std::int32_t>(gather_bits(z_order))};
}

} // namespace heddle
