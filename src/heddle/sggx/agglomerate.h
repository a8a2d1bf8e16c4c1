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

namespace detail {

/// The bits of a float >= 0: they order as it does, and their minimum is an integer instruction.
[[nodiscard]] HEDDLE_INLINE std::uint32_t order_bits(float x) {
    std::uint32_t bits;
    __builtin_memcpy(&bits, &x, sizeof bits);
    return bits;
}

inline constexpr std::uint32_t kAbsent = 0xffffffffu; ///< above the bits of any number

/// order_bits of the distances of lobe i to lobes begin .. end - 1, kAbsent of those that are gone.
template <typename Lobes>
HEDDLE_INLINE void find_distances(const Lobes& lobes,
                                  int i,
                                  int begin,
                                  int end,
                                  const std::uint32_t* absent,
                                  std::uint32_t* row) {
    if constexpr (requires(float* out) { lobes.distances(i, begin, end, out); }) {
        float d[kMaxPool];
        lobes.distances(i, begin, end, d);
        for (int j = begin; j < end; ++j) row[j] = order_bits(d[j]) | absent[j];
    } else {
        for (int j = begin; j < end; ++j) {
            row[j] = absent[j] != 0 ? kAbsent : order_bits(lobes.distance(i, j));
        }
    }
}

} // namespace detail

/// Merges the closest pair of `count` lobes until `keep` are left, and on while it is closer than
/// `same`.                                                              [Fabre26, 4.4, eq. 18]
///
/// Each lobe remembers the lobe of higher number that is closest to it, so that a merge costs about
/// 2 x count distances. Of equally close pairs the first in (lower, higher) number is taken: the
/// result depends on the lobes' order and on nothing else.
///
/// @param count    0 .. kMaxPool
/// @param keep     1 or more
/// @param lobes    float distance(int i, int j), i < j: >= 0, asked for lobes that are there;
///                 void merge(int into, int from): makes lobe `into` the merged one; may have
///                 void distances(int i, int begin, int end, float* out): out[j] = distance(i, j),
///                 i < begin, anything >= 0 for lobes that are gone
/// @param merges   receives at most count - 1 merges, in their order
/// @param same     distance below which lobes need not stay apart; 0: merges just to `keep`
/// @return         number of merges
template <typename Lobes>
HEDDLE_INLINE int
agglomerate(int count, int keep, Lobes& lobes, LobeMerge* merges, float same = 0.0f) {
    if (count < 2 || (count <= keep && !(same > 0.0f))) return 0;
    std::uint32_t least[kMaxPool];  // distance of each to the closest of higher number, and
    std::uint8_t nearest[kMaxPool]; // that lobe
    std::uint32_t absent[kMaxPool]{};
    const auto find_nearest = [&](int i) __attribute__((always_inline)) {
        std::uint32_t row[kMaxPool];
        detail::find_distances(lobes, i, i + 1, count, absent, row);
        std::uint32_t best = detail::kAbsent;
        for (int j = i + 1; j < count; ++j) best = row[j] < best ? row[j] : best;
        least[i] = best;
        int j = i + 1;
        while (j < count && row[j] != best) ++j;
        nearest[i] = static_cast<std::uint8_t>(j);
    };
    for (int i = 0; i < count; ++i) find_nearest(i);
    const std::uint32_t same_bits = detail::order_bits(same);
    int made = 0;
    for (int n = count; n > 1; --n) {
        std::uint32_t best = detail::kAbsent;
        for (int i = 0; i < count; ++i) best = least[i] < best ? least[i] : best;
        if (n <= keep && !(best < same_bits)) break;
        int into = 0;
        while (least[into] != best) ++into;
        const int from = nearest[into];
        lobes.merge(into, from);
        merges[made++] = {static_cast<std::uint8_t>(into), static_cast<std::uint8_t>(from)};
        absent[from] = least[from] = detail::kAbsent;
        for (int i = 0; i < from; ++i) {
            if (absent[i] != 0) continue;
            if (i == into || nearest[i] == from || nearest[i] == into) {
                find_nearest(i);
            } else if (i < into) {
                const std::uint32_t d = detail::order_bits(lobes.distance(i, into));
                if (d < least[i] || (d == least[i] && into < nearest[i])) {
                    least[i] = d;
                    nearest[i] = static_cast<std::uint8_t>(into);
                }
            }
        }
    }
    return made;
}

} // namespace heddle
