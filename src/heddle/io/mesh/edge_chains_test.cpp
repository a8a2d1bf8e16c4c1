#include <heddle/io/mesh/edge_chains.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

using Edges = std::vector<std::array<std::uint32_t, 2>>;

std::vector<Vec3f> points(std::size_t n) {
    std::vector<Vec3f> out;
    for (std::size_t i = 0; i < n; ++i) out.push_back({static_cast<float>(i), 0.0f, 0.0f});
    return out;
}

std::vector<float> xs_of(const CurveSet& set, std::size_t curve) {
    std::vector<float> xs;
    for (std::uint64_t i = set.first[curve]; i < set.first[curve + 1]; ++i)
        xs.push_back(set.points[i].x);
    return xs;
}

TEST(EdgeChains, EdgesInAnyOrderAndDirectionBecomeOneChain) {
    const CurveSet set = chain_edges(points(5), {}, Edges{{2, 1}, {3, 4}, {0, 1}, {3, 2}});
    ASSERT_EQ(set.curve_count(), 1u);
    EXPECT_EQ(set.basis, Basis::Linear);
    EXPECT_FALSE(set.is_closed(0));
    EXPECT_EQ(xs_of(set, 0), (std::vector<float>{4, 3, 2, 1, 0}));
}

TEST(EdgeChains, ARingIsClosedAndDoesNotRepeatItsFirstPoint) {
    const CurveSet set = chain_edges(points(4), {}, Edges{{0, 1}, {1, 2}, {2, 3}, {3, 0}});
    ASSERT_EQ(set.curve_count(), 1u);
    EXPECT_TRUE(set.is_closed(0));
    EXPECT_EQ(xs_of(set, 0).size(), 4u);
}

TEST(EdgeChains, ABranchEndsThreeChains) {
    const CurveSet set = chain_edges(points(4), {}, Edges{{0, 1}, {0, 2}, {0, 3}});
    EXPECT_EQ(set.curve_count(), 3u);
    EXPECT_EQ(set.points.size(), 6u);
}

TEST(EdgeChains, ALoopOnAStalkIsOpenAndAPointsEdgeToItselfIsLeftOut) {
    const CurveSet set = chain_edges(points(4), {}, Edges{{0, 1}, {1, 2}, {2, 3}, {3, 1}, {2, 2}});
    ASSERT_EQ(set.curve_count(), 2u);
    EXPECT_EQ(xs_of(set, 0), (std::vector<float>{0, 1}));
    EXPECT_EQ(xs_of(set, 1), (std::vector<float>{1, 2, 3, 1}));
    EXPECT_FALSE(set.is_closed(1));
}

TEST(EdgeChains, RadiiFollowTheirPoints) {
    const std::vector<float> radius{10.0f, 11.0f, 12.0f};
    const CurveSet set = chain_edges(points(3), radius, Edges{{2, 1}, {1, 0}});
    EXPECT_EQ(set.radius, (std::vector<float>{12.0f, 11.0f, 10.0f}));
}

} // namespace
} // namespace heddle
