#pragma once

#include <array>
#include <cstdint>

namespace heddle {

/// For each mask of eight lanes: the numbers of its set lanes in order, one byte each, lowest
/// first.
inline constexpr std::array<std::uint64_t, 256> kSetLanes = [] {
    std::array<std::uint64_t, 256> table{};
    for (std::uint32_t mask = 0; mask < 256; ++mask) {
        int count = 0;
        for (std::uint64_t lane = 0; lane < 8; ++lane) {
            if ((mask >> lane & 1u) != 0) table[mask] |= lane << (8 * count++);
        }
    }
    return table;
}();

} // namespace heddle
