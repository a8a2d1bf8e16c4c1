#include <heddle/sggx/wasserstein.h>

#include <heddle/sggx/test_lobe.h>
#include <heddle/sggx/test_reduce.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

DirectionSums needle(Vec3d d, double weight, std::uint32_t material = 0) {
    const SymmetricMatrix M = test::pool({normalize(d)});
    DirectionSums s{.weight = static_cast<std::int64_t>(weight * 1e6), .material = material};
    const float entry[6] = {M.xx, M.yy, M.zz, M.xy, M.xz, M.yz};
    for (int k = 0; k < 6; ++k) {
        s.moment[k] = static_cast<std::int64_t>(static_cast<double>(entry[k]) * weight * 1e6);
    }
    return s;
}

DirectionHistogram all_in(int x, int y, int z) {
    DirectionHistogram h{};
    h[static_cast<std::size_t>((z * kHistogramBins + y) * kHistogramBins + x)] = 1.0f;
    return h;
}

TEST(SlicedWasserstein, MovedMassCostsItsMeanProjectedWay) {
    // one bin (0.4) along x: lines along x 1, face diagonals 4 of 6 with 1/sqrt 2, body 1/sqrt 3
    const double mean = (1.0 + 4.0 / std::sqrt(2.0) + 4.0 / std::sqrt(3.0)) / 13.0;
    const DirectionHistogram start = all_in(2, 2, 2);
    EXPECT_NEAR(sliced_wasserstein(start, all_in(3, 2, 2)), 0.4 * mean, 1e-6);
    EXPECT_NEAR(sliced_wasserstein(start, all_in(2, 3, 2)), 0.4 * mean, 1e-6);
    EXPECT_NEAR(sliced_wasserstein(start, all_in(2, 2, 1)), 0.4 * mean, 1e-6);
    EXPECT_NEAR(sliced_wasserstein(all_in(0, 2, 2), all_in(4, 2, 2)), 1.6 * mean, 1e-6);
    EXPECT_EQ(sliced_wasserstein(start, start), 0.0f);
}

TEST(DirectionHistogram, BinsAreFifthsOfTheCube) {
    const Vec3f d[] = {{1, 0, 0}, {-1, 0, 0}, {0, .6f, -.8f}, {0, .7f, .1f}};
    const DirectionHistogram h = direction_histogram(d);
    EXPECT_EQ(h[(2 * 5 + 2) * 5 + 4], 0.25f);
    EXPECT_EQ(h[(2 * 5 + 2) * 5 + 0], 0.25f);
    EXPECT_EQ(h[(0 * 5 + 4) * 5 + 2], 0.25f);
    EXPECT_EQ(h[(2 * 5 + 4) * 5 + 2], 0.25f);
}

TEST(WassersteinLobes, ParallelNeedlesMergeFirstAndCrossedOnesStay) {
    std::vector<DirectionSums> pool{needle({1, 0, 0}, 1), needle({0, 1, 0}, 2),
                                    needle({1, .05, 0}, 3), needle({.05, 1, 0}, 1)};
    LobeMerge merges[4];
    ASSERT_EQ(test::reduce_lobes_by_wasserstein(pool, 2, 7, merges), 2);
    EXPECT_EQ(pool[0].weight, 4000000);
    EXPECT_EQ(pool[1].weight, 3000000);
    EXPECT_GT(pool[0].moment[0], 3900000);
    EXPECT_GT(pool[1].moment[1], 2900000);
}

TEST(WassersteinLobes, AMergedMomentIsTheWeightedMeanUpToSampling) {
    const DirectionSums a = needle({1, 2, 0}, 1);
    const DirectionSums b = needle({0, 1, -1}, 3);
    std::vector<DirectionSums> pool{a, b};
    WassersteinLobes lobes(pool, 3);
    lobes.merge(0, 1);
    EXPECT_LT(test::difference(detail::mean_moment(pool[0]), detail::mean_moment(merged(a, b))),
              1e-3);
}

TEST(WassersteinLobes, TheSameSeedGivesTheSameBitsAndAnotherDoesNot) {
    const auto run = [](std::uint64_t seed) {
        std::vector<DirectionSums> pool;
        CounterRandom random{5, 1};
        for (int i = 0; i < 6; ++i) pool.push_back(needle(test::random_direction(random), 1.0 + i));
        LobeMerge merges[6];
        pool.resize(
            static_cast<std::size_t>(test::reduce_lobes_by_wasserstein(pool, 3, seed, merges)));
        return pool;
    };
    EXPECT_EQ(run(1), run(1));
    EXPECT_NE(run(1), run(2));
}

TEST(WassersteinLobes, MaterialsAndKindsMergeLast) {
    std::vector<DirectionSums> pool{needle({1, 0, 0}, 1, 1), needle({1, 0, 0}, 2, 2),
                                    needle({0, 1, 0}, 1, 1)};
    pool[1].normals = true;
    LobeMerge merges[3];
    ASSERT_EQ(test::reduce_lobes_by_wasserstein(pool, 1, 7, merges), 1);
    EXPECT_EQ(merges[0].into, 0);
    EXPECT_EQ(merges[0].from, 2);
    EXPECT_EQ(pool[0].weight, 4000000);
    EXPECT_FALSE(pool[0].normals && pool[0].material == 1);
}

} // namespace
} // namespace heddle
