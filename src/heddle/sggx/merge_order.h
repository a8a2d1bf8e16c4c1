#pragma once

#include <heddle/base/platform.h>
#include <heddle/sggx/agglomerate.h>

#include <cstdint>

namespace heddle {

/// The largest number of lobes that a voxel stores.
inline constexpr int kMaxLobes = 8;

/// The order in which a voxel's lobes are stored so that a reader can reduce their number: with n
/// lobes left, the last one is merged into the one that `targets` names.
struct MergeOrder {
    std::uint8_t place[kMaxLobes]{}; ///< where lobe i is stored; the heaviest is first
    std::uint32_t targets = 0; ///< what stored lobe n merges into: bits 4 (n - 2) and up; 0: lobe 0
};

/// Numbers the lobes of a dendrogram from its root down: where a lobe splits, the part that
/// contains the heaviest single lobe keeps the number; the other part takes the next one.
///
/// @param count    1 .. kMaxLobes
/// @param merges   the count - 1 merges of agglomerate(count, 1)
/// @param weight   weights of the lobes before they merged; equal ones are ordered by number
template <typename Weight>
[[nodiscard]] HEDDLE_HD inline MergeOrder
order_merges(int count, const LobeMerge* merges, const Weight* weight) {
    std::uint8_t peak[kMaxLobes]; // the heaviest single lobe in each merged lobe
    bool swapped[kMaxLobes]{};    // merge k: `from` contains the heavier one
    for (int i = 0; i < count; ++i) peak[i] = static_cast<std::uint8_t>(i);
    for (int k = 0; k + 1 < count; ++k) {
        const int a = peak[merges[k].into];
        const int b = peak[merges[k].from];
        swapped[k] = weight[b] > weight[a] || (weight[b] == weight[a] && b < a);
        if (swapped[k]) peak[merges[k].into] = static_cast<std::uint8_t>(b);
    }
    MergeOrder order;
    int next = 1;
    for (int k = count - 2; k >= 0; --k, ++next) {
        const LobeMerge& m = merges[k];
        const std::uint8_t kept = order.place[m.into];
        if (next > 1) order.targets |= static_cast<std::uint32_t>(kept) << (4 * (next - 2));
        order.place[m.from] = swapped[k] ? kept : static_cast<std::uint8_t>(next);
        order.place[m.into] = swapped[k] ? static_cast<std::uint8_t>(next) : kept;
    }
    return order;
}

} // namespace heddle
