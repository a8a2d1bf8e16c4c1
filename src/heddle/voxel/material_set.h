#pragma once

#include <heddle/base/bits.h>
#include <heddle/base/platform.h>

#include <cstdint>

namespace heddle {

/// A set of a geometry's materials, of which there are at most 256. It is uploaded as it is.
struct MaterialSet {
    std::uint64_t words[4]{}; ///< bit m % 64 of word m / 64 stands for material m

    [[nodiscard]] HEDDLE_HD static constexpr std::uint64_t bit_of(std::uint32_t material) {
        return std::uint64_t{1} << (material % 64);
    }
    [[nodiscard]] HEDDLE_HD bool has(std::uint32_t material) const {
        return (words[material / 64] & bit_of(material)) != 0;
    }
    HEDDLE_HD void add(std::uint32_t material) { words[material / 64] |= bit_of(material); }
    [[nodiscard]] HEDDLE_HD std::uint32_t count() const {
        std::uint32_t sum = 0;
        for (const std::uint64_t w : words) sum += static_cast<std::uint32_t>(count_bits(w));
        return sum;
    }
    /// Returns the count of materials in the set with smaller numbers.
    [[nodiscard]] HEDDLE_HD std::uint32_t count_below(std::uint32_t material) const {
        std::uint32_t sum = 0;
        for (std::uint32_t w = 0; w < material / 64; ++w) {
            sum += static_cast<std::uint32_t>(count_bits(words[w]));
        }
        return sum + static_cast<std::uint32_t>(
                         count_bits(words[material / 64] & (bit_of(material) - 1)));
    }
    /// Calls visit(material) for each material in the set, in ascending order.
    template <typename Visit>
    HEDDLE_HD void for_each(const Visit& visit) const {
        for (std::uint32_t w = 0; w < 4; ++w) {
            for (std::uint64_t bits = words[w]; bits != 0; bits &= bits - 1) {
                visit(w * 64 + static_cast<std::uint32_t>(lowest_bit(bits)));
            }
        }
    }
};
static_assert(sizeof(MaterialSet) == 32, "the same on host and device");

} // namespace heddle
