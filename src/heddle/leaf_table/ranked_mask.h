#pragma once

#include <heddle/base/vec.h>

#include <array>
#include <bit>
#include <cstdint>

namespace heddle {

/// The mask of the active voxels among a leaf's 8^3, with counts that give an active voxel's number
/// without a search.
struct RankedMask {
    std::array<std::uint64_t, 8> active{}; ///< laid out as VoxelLeaf::active
    std::array<std::uint16_t, 8> before{}; ///< [x]: number of active voxels in the words before x

    RankedMask() = default;
    explicit RankedMask(const std::array<std::uint64_t, 8>& words) : active(words) {
        for (std::size_t x = 1; x < 8; ++x) {
            before[x] = static_cast<std::uint16_t>(before[x - 1] + std::popcount(active[x - 1]));
        }
    }
    [[nodiscard]] std::uint32_t count() const {
        return static_cast<std::uint32_t>(before[7] + std::popcount(active[7]));
    }
    /// Returns the number of a voxel among the active ones in ascending (x, y, z); -1 if not
    /// active.
    /// @param at  any voxel index; only its lowest three bits are used
    [[nodiscard]] std::int32_t find(Vec3i at) const {
        const auto x = static_cast<std::size_t>(at.x & 7);
        const int bit = (at.y & 7) * 8 + (at.z & 7);
        const std::uint64_t word = active[x];
        if ((word >> bit & 1) == 0) return -1;
        return before[x] + std::popcount(word & ((std::uint64_t{1} << bit) - 1));
    }
};
static_assert(sizeof(RankedMask) == 80);

} // namespace heddle
