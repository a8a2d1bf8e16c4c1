#pragma once

#include <heddle/base/platform.h>

#include <bit>
#include <cstdint>

namespace heddle {

/// Number of the lowest bit that is set. @pre bits != 0
[[nodiscard]] HEDDLE_INLINE int lowest_bit(std::uint32_t bits) {
#if HEDDLE_DEVICE_PASS
    return __ffs(static_cast<int>(bits)) - 1;
#else
    return std::countr_zero(bits);
#endif
}

/// The same for a 64-bit word. @pre bits != 0
[[nodiscard]] HEDDLE_INLINE int lowest_bit(std::uint64_t bits) {
#if HEDDLE_DEVICE_PASS
    return __ffsll(static_cast<long long>(bits)) - 1;
#else
    return std::countr_zero(bits);
#endif
}

/// The number of bits that are set.
[[nodiscard]] HEDDLE_INLINE int count_bits(std::uint64_t bits) {
#if HEDDLE_DEVICE_PASS
    return __popcll(bits);
#else
    return std::popcount(bits);
#endif
}

} // namespace heddle
