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
///                 void merge(int into, int from): makes lobe `into` the merged one
/// @param merges   receives at most count - 1 merges, in their order
/// @param same     distance below which lobes need not stay apart; 0: merges just to `keep`
/// @return         number of merges
template <typename Lobes>
HEDDLE_HD inline int
agglomerate(int count, int keep, Lobes& lobes, LobeMerge* merges, float same = 0.0f) {
    float least[kMaxPool];
    std::int8_t nearest[kMaxPool];
    std::int8_t left[kMaxPool]; // numbers of the lobes that are there, ascending
    for (int i = 0; i < count; ++i) left[i] = static_cast<std::int8_t>(i);
    const auto find_nearest = [&](int at, int n) {
        const int i = left[at];
        nearest[i] = -1;
        for (int b = at + 1; b < n; ++b) {
            const float d = lobes.distance(i, left[b]);
            if (nearest[i] < 0 || d < least[i]) {
                least[i] = d;
                nearest[i] = left[b];
            }
        }
    };
    if (count <= keep && !(same > 0.0f)) return 0;
    for (int a = 0; a < count; ++a) find_nearest(a, count);
    int made = 0;
    for (int n = count; n > 1; --n) {
        int into = left[0];
        for (int a = 1; a + 1 < n; ++a) {
            if (least[left[a]] < least[into]) into = left[a];
        }
        if (n <= keep && !(least[into] < same)) break;
        const int from = nearest[into];
        lobes.merge(into, from);
        merges[made++] = {static_cast<std::uint8_t>(into), static_cast<std::uint8_t>(from)};
        int kept = 0;
        for (int a = 0; a < n; ++a) {
            if (left[a] != from) left[kept++] = left[a];
        }
        for (int a = 0; a < n - 1; ++a) {
            const int i = left[a];
            if (i == into || nearest[i] == from || nearest[i] == into) {
                find_nearest(a, n - 1);
            } else if (i < into) {
                const float d = lobes.distance(i, into);
                if (d < least[i] || (d == least[i] && into < nearest[i])) {
                    least[i] = d;
                    nearest[i] = static_cast<std::int8_t>(into);
                }
            }
        }
    }
    return made;
}

} // namespace heddle
