#include <heddle/leaf_table/leaf_table.h>

#include <heddle/base/random.h>
#include <heddle/leaf_table/ranked_mask.h>

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <tuple>

namespace heddle {
namespace {

using Key = std::tuple<int, int, int>;

/// Origins of leaves near the scene's origin and far apart, each once.
std::map<Key, std::uint32_t> scattered_leaves() {
    std::map<Key, std::uint32_t> leaves;
    StreamRandom random{5};
    for (const Vec3i corner : {Vec3i{-160, -160, -160}, {1000000, -300000, 64}, {-70000, 8, -8}}) {
        for (int i = 0; i < 300; ++i) {
            const auto step = [&] { return static_cast<int>(random.next() % 40) * 8; };
            leaves[{(corner.x & ~7) + step(), (corner.y & ~7) + step(), (corner.z & ~7) + step()}];
        }
    }
    return leaves;
}

template <int kTileBits>
LeafTable<kTileBits> table_of(std::map<Key, std::uint32_t>& leaves) {
    LeafTable<kTileBits> table;
    for (auto& [at, number] : leaves) {
        const auto [x, y, z] = at;
        number = table.add({x, y, z});
    }
    return table;
}

template <int kTileBits>
void expect_leaves_and_no_other() {
    std::map<Key, std::uint32_t> leaves = scattered_leaves();
    const LeafTable<kTileBits> table = table_of<kTileBits>(leaves);
    ASSERT_EQ(table.size(), leaves.size());
    for (const auto& [at, number] : leaves) {
        const auto [x, y, z] = at;
        for (int dx = -1; dx <= 1; ++dx) {
            for (int dz = -1; dz <= 1; ++dz) {
                const Vec3i near{x + 8 * dx, y, z + 8 * dz};
                const auto wanted = leaves.find({near.x, near.y, near.z});
                const auto place = table.find(near + Vec3i{7, 3, 0});
                EXPECT_EQ(place.leaf, wanted == leaves.end() ? table.kNone : wanted->second);
                EXPECT_TRUE(place.leaf == table.kNone || place.size == 8);
            }
        }
    }
}

TEST(LeafTable, FindsEveryLeafAndNoOther) {
    expect_leaves_and_no_other<3>();
    expect_leaves_and_no_other<4>();
}

TEST(LeafTable, WhatItCallsEmptyIsEmpty) {
    std::map<Key, std::uint32_t> leaves = scattered_leaves();
    const LeafTable<3> table = table_of<3>(leaves);
    StreamRandom random{7};
    for (int i = 0; i < 500; ++i) {
        const auto index = [&] { return static_cast<int>(random.next() % 600) - 300; };
        const Vec3i at{index(), index(), index()};
        const LeafTable<3>::LeafLookup place = table.find(at);
        if (place.leaf != table.kNone) continue;
        const int mask = ~(place.size - 1);
        for (int x = at.x & mask; x < (at.x & mask) + place.size; x += 8) {
            for (int y = at.y & mask; y < (at.y & mask) + place.size; y += 8) {
                for (int z = at.z & mask; z < (at.z & mask) + place.size; z += 8) {
                    EXPECT_FALSE(leaves.contains({x, y, z}));
                }
            }
        }
    }
}

TEST(LeafTable, ListsItsTilesWithTheirLeaves) {
    std::map<Key, std::uint32_t> leaves = scattered_leaves();
    const LeafTable<4> table = table_of<4>(leaves);
    ASSERT_EQ(table.leaves_by_tile().size(), table.tiles().size() * table.kTileLeaves);
    std::size_t listed = 0;
    for (std::uint32_t t = 0; t < table.tiles().size(); ++t) {
        EXPECT_EQ(table.find_tile(table.tiles()[t]), t);
        for (std::size_t i = 0; i < table.kTileLeaves; ++i) {
            if (table.leaves_by_tile()[t * table.kTileLeaves + i] != table.kNone) ++listed;
        }
    }
    EXPECT_EQ(listed, leaves.size());
}

TEST(LeafTable, AnEmptyTableHoldsNothing) {
    const LeafTable<3> table;
    EXPECT_EQ(table.size(), 0u);
    EXPECT_EQ(table.find({-1, 0, 99}).leaf, table.kNone);
    EXPECT_EQ(table.find({-1, 0, 99}).size, 64);
}

TEST(IndexTable, NumbersCellsInTheOrderInWhichTheyComeAndOnce) {
    constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min();
    IndexTable table;
    EXPECT_EQ(table.find({0, 0, 0}), IndexTable::kNone);
    EXPECT_EQ(table.add({kLow, 0, -1}), 0u);
    EXPECT_EQ(table.add({0, 0, 0}), 1u);
    EXPECT_EQ(table.add({kLow, 0, -1}), 0u);
    for (int i = 1; i < 5000; ++i) EXPECT_EQ(table.add({i, -i, 7 * i}), 1u + i);
    EXPECT_EQ(table.size(), 5001u);
    EXPECT_EQ(table.find({4999, -4999, 7 * 4999}), 5000u);
    EXPECT_EQ(table.find({5000, -5000, 35000}), IndexTable::kNone);
}

TEST(RankedMask, NumbersActiveVoxelsInAscendingOrder) {
    std::array<std::uint64_t, 8> active{};
    StreamRandom random{3};
    for (std::uint64_t& word : active) word = random.next() & random.next();
    active[2] = 0;
    active[7] |= std::uint64_t{1} << 63;
    const RankedMask mask(active);
    std::int32_t number = 0;
    for (int i = 0; i < 512; ++i) {
        const bool is = (active[static_cast<std::size_t>(i >> 6)] >> (i & 63) & 1) != 0;
        EXPECT_EQ(mask.find({(i >> 6) - 800, i >> 3 & 7, (i & 7) + 64}), is ? number++ : -1);
    }
    EXPECT_EQ(mask.count(), static_cast<std::uint32_t>(number));
}

} // namespace
} // namespace heddle
