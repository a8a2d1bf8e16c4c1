#pragma once

#include <heddle/base/platform.h>

#include <cstdint>

namespace heddle {

/// Finds the range that contains element `i`, among ranges that are stored end to end.
/// @param offsets  n + 1 ascending numbers; the first is 0; ranges may be empty
/// @param i        < offsets[n]
/// @return         r with offsets[r] <= i < offsets[r + 1]
[[nodiscard]] HEDDLE_HD constexpr std::uint64_t
range_of(const std::uint64_t* offsets, std::uint64_t n, std::uint64_t i) {
    std::uint64_t lo = 0;
    std::uint64_t hi = n;
    while (hi - lo > 1) {
        const std::uint64_t middle = lo + (hi - lo) / 2;
        if (offsets[middle] <= i) {
            lo = middle;
        } else {
            hi = middle;
        }
    }
    return lo;
}

} // namespace heddle
