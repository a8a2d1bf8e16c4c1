#pragma once

#include <heddle/base/platform.h>

#include <cstdint>

namespace heddle {

/// Most lobes that can be merged at once: eight voxels of eight.
inline constexpr int kMaxPool = 64;

/// Two lobes that became one: lobe `from` is gone, lobe `into` (a lower number) holds both.
struct LobeMerge {
    std::uint8_t into = 0;
    std::uint8_t from = 0;
};

/// The number of distances that are computed at once: a vector of floats.
inline constexpr int kPoolRow = 8;

namespace detail {

/// Sort key of a pair of lobes: the upper bits of its distance (to within 2^-17 of it) and the
/// number of the higher lobe. The closest pair is then a minimum of integers.
[[nodiscard]] HEDDLE_INLINE std::uint32_t pair_key(float distance, int higher) {
    std::uint32_t bits;
    __builtin_memcpy(&bits, &distance, sizeof bits);
    return (bits & ~std::uint32_t{kMaxPool - 1}) | static_cast<std::uint32_t>(higher);
}
[[nodiscard]] HEDDLE_INLINE int higher_of(std::uint32_t key) {
    return static_cast<int>(key & (kMaxPool - 1));
}

inline constexpr std::uint32_t kNoPair = 0xffffffffu; ///< above the key of any pair

/// out[k] = distance(i, begin + k).
template <typename Lobes>
HEDDLE_INLINE void find_distances(
    const Lobes& lobes, int i, int begin, const std::uint32_t* absent, float (&out)[kPoolRow]) {
    if constexpr (requires { lobes.distances(i, begin, out); }) {
        lobes.distances(i, begin, out);
    } else {
        for (int k = 0; k < kPoolRow; ++k) {
            const bool asked = begin + k > i && absent[begin + k] == 0;
            out[k] = asked ? lobes.distance(i, begin + k) : 0.0f;
        }
    }
}

/// The key of the closest pair of lobe i and a lobe of higher number.
/// @param end  end of the lobes, a multiple of kPoolRow
template <typename Lobes>
[[nodiscard]] HEDDLE_INLINE std::uint32_t
nearest_key(const Lobes& lobes, int i, int end, const std::uint32_t* absent) {
    std::uint32_t least[kPoolRow];
    for (std::uint32_t& key : least) key = kNoPair;
    for (int begin = (i + 1) & -kPoolRow; begin < end; begin += kPoolRow) {
        float d[kPoolRow];
        find_distances(lobes, i, begin, absent, d);
        for (int k = 0; k < kPoolRow; ++k) {
            const std::uint32_t below = begin + k > i ? 0 : kNoPair;
            const std::uint32_t key = pair_key(d[k], begin + k) | absent[begin + k] | below;
            least[k] = key < least[k] ? key : least[k];
        }
    }
    std::uint32_t best = kNoPair;
    for (const std::uint32_t key : least) best = key < best ? key : best;
    return best;
}

} // namespace detail

/// Merges the closest pair of `count` lobes until `keep` are left, then further while the closest
/// pair is closer than `same`.                                               [Fabre26, 4.4, eq. 18]
///
/// Each lobe remembers the closest lobe of higher number, so that a merge costs about 2 x count
/// distances. Among pairs whose distances agree to 2^-17, the one with the lowest higher number is
/// merged, then the one with the lowest lower number: the result depends only on the order of
/// lobes.
///
/// @param count    0 .. kMaxPool
/// @param keep     1 or more
/// @param lobes    float distance(int i, int j), i < j: >= 0, called for lobes that exist;
///                 void merge(int into, int from): makes lobe `into` the merged one; optionally
///                 void distances(int i, int begin, float (&out)[kPoolRow]): out[k] =
///                 distance(i, begin + k), any value if that is no pair of existing lobes
/// @param merges   receives at most count - 1 merges, in their order
/// @param same     distance below which lobes are always merged; 0: merges just to `keep`
/// @return         number of merges
template <typename Lobes>
HEDDLE_INLINE int
agglomerate(int count, int keep, Lobes& lobes, LobeMerge* merges, float same = 0.0f) {
    if (count < 2 || (count <= keep && !(same > 0.0f))) return 0;
    const int end = (count + kPoolRow - 1) & -kPoolRow;
    std::uint32_t nearest[kMaxPool]; // of each lobe
    std::uint32_t absent[kMaxPool];
    for (int i = 0; i < end; ++i) absent[i] = i < count ? 0 : detail::kNoPair;
    for (int i = 0; i < end; ++i) nearest[i] = detail::kNoPair;
    for (int i = 0; i + 1 < count; ++i) {
        nearest[i] = detail::nearest_key(lobes, i, end, absent);
    }
    const std::uint32_t same_key = detail::pair_key(same, 0);
    int made = 0;
    for (int n = count; n > 1; --n) {
        std::uint32_t best = detail::kNoPair;
        for (int i = 0; i < end; ++i) best = nearest[i] < best ? nearest[i] : best;
        if (n <= keep && best >= same_key) break;
        int into = 0;
        while (nearest[into] != best) ++into;
        const int from = detail::higher_of(best);
        lobes.merge(into, from);
        merges[made++] = {static_cast<std::uint8_t>(into), static_cast<std::uint8_t>(from)};
        absent[from] = nearest[from] = detail::kNoPair;
        for (int i = 0; i < from; ++i) {
            if (absent[i] != 0) continue;
            const int now = detail::higher_of(nearest[i]);
            if (i == into || now == from || now == into) {
                nearest[i] = detail::nearest_key(lobes, i, end, absent);
            } else if (i < into) {
                const std::uint32_t key = detail::pair_key(lobes.distance(i, into), into);
                nearest[i] = key < nearest[i] ? key : nearest[i];
            }
        }
    }
    return made;
}

} // namespace heddle
