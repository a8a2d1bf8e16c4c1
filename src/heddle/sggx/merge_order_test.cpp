#include <heddle/sggx/merge_order.h>

#include <heddle/base/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace heddle {
namespace {

/// Lobes on a line that merge to their weighted mean.
struct LineLobes {
    std::vector<float> at, weight;
    std::vector<std::set<int>> holds;

    explicit LineLobes(std::vector<float> x, std::vector<float> w)
        : at(std::move(x)), weight(std::move(w)), holds(at.size()) {
        for (std::size_t i = 0; i < at.size(); ++i) holds[i] = {static_cast<int>(i)};
    }
    [[nodiscard]] float distance(int i, int j) const {
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
        return std::abs(at[a] - at[b]);
    }
    void merge(int into, int from) {
        const auto a = static_cast<std::size_t>(into), b = static_cast<std::size_t>(from);
        at[a] = (at[a] * weight[a] + at[b] * weight[b]) / (weight[a] + weight[b]);
        weight[a] += weight[b];
        holds[a].insert(holds[b].begin(), holds[b].end());
    }
};

/// The merges that a search through all pairs makes.
std::vector<LobeMerge> merge_by_search(LineLobes lobes, int keep) {
    std::vector<int> left;
    for (std::size_t i = 0; i < lobes.at.size(); ++i) left.push_back(static_cast<int>(i));
    std::vector<LobeMerge> merges;
    while (static_cast<int>(left.size()) > keep) {
        int best_i = left[0], best_j = left[1];
        for (std::size_t a = 0; a < left.size(); ++a) {
            for (std::size_t b = a + 1; b < left.size(); ++b) {
                const auto key = [&](int i, int j) {
                    return std::pair(detail::pair_key(lobes.distance(i, j), j), i);
                };
                if (key(left[a], left[b]) < key(best_i, best_j)) {
                    best_i = left[a];
                    best_j = left[b];
                }
            }
        }
        lobes.merge(best_i, best_j);
        merges.push_back({static_cast<std::uint8_t>(best_i), static_cast<std::uint8_t>(best_j)});
        std::erase(left, best_j);
    }
    return merges;
}

LineLobes random_lobes(std::uint64_t seed, int count, int steps) {
    std::vector<float> x, w;
    for (int i = 0; i < count; ++i) {
        const auto k = static_cast<std::uint64_t>(i);
        // few different positions: ties are common
        x.push_back(static_cast<float>(hash64(seed, k, 0) % static_cast<std::uint64_t>(steps)));
        w.push_back(static_cast<float>(1 + hash64(seed, k, 1) % 5));
    }
    return LineLobes(x, w);
}

TEST(Agglomerate, MakesTheMergesOfASearchThroughAllPairs) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const int count = 1 + static_cast<int>(seed % 40);
        LineLobes lobes = random_lobes(seed, count, seed % 2 == 0 ? 1000 : 12);
        const std::vector<LobeMerge> expected = merge_by_search(lobes, 3);
        LobeMerge merges[kMaxPool];
        const int made = agglomerate(count, 3, lobes, merges);
        ASSERT_EQ(made, static_cast<int>(expected.size()));
        for (int k = 0; k < made; ++k) {
            const auto at = static_cast<std::size_t>(k);
            EXPECT_EQ(merges[k].into, expected[at].into) << seed << " merge " << k;
            EXPECT_EQ(merges[k].from, expected[at].from) << seed << " merge " << k;
        }
    }
}

TEST(MergeOrder, FewerLobesAreTheDendrogramsAndTheHeaviestIsFirst) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const int count = 1 + static_cast<int>(seed % kMaxLobes);
        const LineLobes lobes = random_lobes(seed, count, 1000);
        LobeMerge merges[kMaxPool];
        LineLobes whole = lobes;
        agglomerate(count, 1, whole, merges);
        const MergeOrder order = order_merges(count, merges, lobes.weight.data());

        std::vector<std::set<int>> stored(static_cast<std::size_t>(count)); // by stored number
        for (int i = 0; i < count; ++i) stored[order.place[i]].insert(i);
        const int first = *stored[0].begin();
        EXPECT_EQ(lobes.weight[static_cast<std::size_t>(first)],
                  *std::max_element(lobes.weight.begin(), lobes.weight.end()));
        for (int n = count; n >= 1; --n) {
            LineLobes cut = lobes;
            LobeMerge ignored[kMaxPool];
            agglomerate(count, n, cut, ignored);
            for (const std::set<int>& group : stored) {
                EXPECT_NE(std::find(cut.holds.begin(), cut.holds.end(), group), cut.holds.end());
            }
            if (n == 1) break;
            const int target = n == 2 ? 0 : static_cast<int>(order.targets >> (4 * (n - 3)) & 15u);
            ASSERT_LT(target, n - 1);
            stored[static_cast<std::size_t>(target)].merge(stored.back());
            stored.pop_back();
        }
    }
}

} // namespace
} // namespace heddle
