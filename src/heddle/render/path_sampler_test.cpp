#include <heddle/render/path_sampler.h>

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <vector>

namespace heddle {
namespace {

/// Pair number `which` of samples [first, first + count) of one pixel.
std::vector<std::array<float, 2>>
pairs_of(std::uint64_t pixel, int which, std::uint32_t first, std::uint32_t count) {
    std::vector<std::array<float, 2>> out;
    for (std::uint32_t s = first; s < first + count; ++s) {
        PathSampler sampler(3, pixel, s);
        for (int i = 0; i < which; ++i) static_cast<void>(sampler.pair());
        out.push_back(sampler.pair());
    }
    return out;
}

// A (0, k, 2) net: every elementary interval of area 2^-k holds one of 2^k points.
void expect_net(const std::vector<std::array<float, 2>>& points, int k) {
    for (int i = 0; i <= k; ++i) {
        std::set<std::pair<int, int>> boxes;
        for (const auto& [x, y] : points) {
            ASSERT_TRUE(x >= 0.0f && x < 1.0f && y >= 0.0f && y < 1.0f);
            boxes.insert({static_cast<int>(x * static_cast<float>(1 << i)),
                          static_cast<int>(y * static_cast<float>(1 << (k - i)))});
        }
        EXPECT_EQ(boxes.size(), points.size()) << "boxes of 2^-" << i << " x 2^-" << k - i;
    }
}

TEST(PathSampler, PowersOfTwoAreStratifiedInEveryElementaryInterval) {
    for (std::uint64_t pixel = 0; pixel < 8; ++pixel) {
        for (const int which : {0, 1, 7}) {
            for (const int k : {2, 4, 6}) expect_net(pairs_of(pixel, which, 0, 1u << k), k);
        }
    }
}

TEST(PathSampler, LaterPowersOfTwoAreStratifiedToo) {
    for (std::uint64_t pixel = 0; pixel < 8; ++pixel) {
        expect_net(pairs_of(pixel, 2, 16, 16), 4);
        expect_net(pairs_of(pixel, 2, 192, 64), 6);
    }
}

TEST(PathSampler, IsTheSameEachTimeAndDiffersByPixelPairAndSeed) {
    const auto first = [](std::uint64_t seed, std::uint64_t pixel) {
        PathSampler sampler(seed, pixel, 5);
        return sampler.pair();
    };
    EXPECT_EQ(first(1, 2), first(1, 2));
    EXPECT_NE(first(1, 2), first(1, 3));
    EXPECT_NE(first(1, 2), first(2, 2));
    EXPECT_NE(pairs_of(1, 0, 0, 1), pairs_of(1, 1, 0, 1));
}

TEST(PathSampler, NumbersBehindThePaddedOnesAreUniform) {
    double sum = 0.0;
    constexpr int kCount = 20000;
    for (std::uint32_t s = 0; s < kCount; ++s) {
        PathSampler sampler(1, 7, s);
        for (int i = 0; i < 20; ++i) static_cast<void>(sampler.pair());
        const float x = sampler.one();
        ASSERT_TRUE(x >= 0.0f && x < 1.0f);
        sum += static_cast<double>(x);
    }
    EXPECT_NEAR(sum / kCount, 0.5, 0.01);
}

} // namespace
} // namespace heddle
