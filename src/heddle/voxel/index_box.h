#pragma once

#include <heddle/voxel/voxel_level.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

namespace heddle {

/// The first and the last index of some voxels on each axis. It starts empty, with lo > hi.
struct IndexBox {
    static constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();

    Vec3i lo{kMost, kMost, kMost};
    Vec3i hi{-kMost, -kMost, -kMost}; ///< inclusive

    [[nodiscard]] bool empty() const { return lo.x > hi.x; }
    void grow(const IndexBox& box) {
        for (int a = 0; a < 3; ++a) {
            lo[a] = std::min(lo[a], box.lo[a]);
            hi[a] = std::max(hi[a], box.hi[a]);
        }
    }
    void grow(Vec3i index) { grow(IndexBox{index, index}); }
};

/// Returns the box of a leaf's voxels; empty if it has none.
[[nodiscard]] inline IndexBox box_of(const VoxelLeaf& leaf) {
    std::uint32_t layers = 0; // bit x is set if any voxel has that x
    std::uint64_t face = 0;   // bit y * 8 + z is set if any voxel has that y and z
    for (std::uint32_t x = 0; x < 8; ++x) {
        layers |= (leaf.active[x] != 0 ? 1u : 0u) << x;
        face |= leaf.active[x];
    }
    if (layers == 0) return {};
    std::uint64_t row = face | face >> 32; // bits 0 to 7 become one bit per z
    row |= row >> 16;
    row |= row >> 8;
    const auto z = static_cast<std::uint32_t>(row & 255);
    const auto last = [](auto bits) { return static_cast<std::int32_t>(std::bit_width(bits)) - 1; };
    return {leaf.origin +
                Vec3i{std::countr_zero(layers), std::countr_zero(face) >> 3, std::countr_zero(z)},
            leaf.origin + Vec3i{last(layers), last(face) >> 3, last(z)}};
}

} // namespace heddle
