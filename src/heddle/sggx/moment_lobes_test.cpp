#include <heddle/sggx/moment_lobes.h>

#include <heddle/sggx/mixture_error.h>
#include <heddle/sggx/moments.h>
#include <heddle/sggx/test_lobe.h>
#include <heddle/sggx/test_reduce.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace heddle {
namespace {

using Pool = std::vector<DirectionSums>;
constexpr double kUnit = 1 << 20;

DirectionSums lobe(const SymmetricMatrix& M, double weight, std::uint32_t material = 0) {
    DirectionSums s{.weight = static_cast<std::int64_t>(weight * kUnit), .material = material};
    const float entry[6] = {M.xx, M.yy, M.zz, M.xy, M.xz, M.yz};
    for (int k = 0; k < 6; ++k) {
        s.moment[k] = static_cast<std::int64_t>(static_cast<double>(entry[k]) * weight * kUnit);
    }
    return s;
}

DirectionSums needle(Vec3d d, double weight, std::uint32_t material = 0) {
    return lobe(test::pool({normalize(d)}), weight, material);
}

/// `count` lobes of any shape, weights 0.05 .. 1, materials 0 .. materials - 1.
Pool random_pool(int count, std::uint32_t materials, CounterRandom& random) {
    Pool pool;
    for (int i = 0; i < count; ++i) {
        const SggxMatrix S = test::random_sggx({1.0, .02 + test::uniform(random), .02}, random);
        pool.push_back(lobe(second_moment_of(S), .05 + .95 * test::uniform(random),
                            static_cast<std::uint32_t>(random.next() % materials)));
    }
    return pool;
}

/// Reduces the pool and removes the lobes that merged into others.
std::vector<LobeMerge> reduce(Pool& pool, int keep, float same = 0.0f) {
    std::vector<LobeMerge> merges(kMaxPool);
    const int left = test::reduce_lobes(pool, keep, merges.data(), same);
    merges.resize(pool.size() - static_cast<std::size_t>(left));
    pool.resize(static_cast<std::size_t>(left));
    return merges;
}

SymmetricMatrix mean_of(const DirectionSums& s) {
    return detail::mean_moment(s);
}

TEST(MomentLobes, MergedSumsAreExact) {
    CounterRandom random{11, 1};
    Pool pool = random_pool(40, 1, random);
    DirectionSums all{.material = 0};
    for (const DirectionSums& s : pool) {
        for (int k = 0; k < 6; ++k) all.moment[k] += s.moment[k];
        all.weight += s.weight;
    }
    reduce(pool, 1);
    ASSERT_EQ(pool.size(), 1u);
    EXPECT_EQ(pool[0], all);
}

TEST(MomentLobes, DistanceOfPerpendicularNeedlesIsTwiceTheirHarmonicShare) {
    Pool pool{needle({1, 0, 0}, 3.0), needle({0, 0, 1}, 1.0), needle({1, 0, 0}, 4.0)};
    const MomentLobes lobes(pool);
    EXPECT_FLOAT_EQ(lobes.distance(0, 1), 2.0f * (3.0f / 8 * 1.0f / 8) / (4.0f / 8));
    EXPECT_EQ(lobes.distance(0, 1), lobes.distance(1, 0));
    EXPECT_EQ(lobes.distance(0, 2), 0.0f);
}

TEST(MomentLobes, EveryMergeIsThatOfTheClosestPair) {
    CounterRandom random{11, 2};
    for (int trial = 0; trial < 50; ++trial) {
        Pool pool = random_pool(24, 2, random);
        Pool checked = pool;
        const std::vector<LobeMerge> merges = reduce(pool, 3);
        std::vector<bool> gone(checked.size());
        ASSERT_EQ(merges.size(), 21u);
        MomentLobes lobes(checked);
        for (const LobeMerge& merge : merges) {
            float least = 1e30f;
            for (int i = 0; i < 24; ++i) {
                for (int j = i + 1; j < 24; ++j) {
                    if (gone[static_cast<std::size_t>(i)] || gone[static_cast<std::size_t>(j)]) {
                        continue;
                    }
                    least = std::min(least, lobes.distance(i, j));
                }
            }
            EXPECT_EQ(lobes.distance(merge.into, merge.from), least);
            lobes.merge(merge.into, merge.from);
            gone[merge.from] = true;
        }
    }
}

TEST(MomentLobes, FewerLobesComeFromTheSameMerges) {
    CounterRandom random{11, 3};
    const Pool pool = random_pool(24, 3, random);
    Pool at_once = pool;
    Pool stepwise = pool;
    const std::vector<LobeMerge> all = reduce(at_once, 1);
    const std::vector<LobeMerge> first = reduce(stepwise, 3);
    for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(all[i].into, first[i].into);
        EXPECT_EQ(all[i].from, first[i].from);
    }
    reduce(stepwise, 1);
    EXPECT_EQ(stepwise, at_once);
}

TEST(MomentLobes, CrossedBundlesKeepTwoLobes) {
    CounterRandom random{11, 4};
    Pool pool;
    DirectionTruth truth;
    for (int i = 0; i < 24; ++i) {
        const Vec3d axis = i % 2 == 0 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
        const Vec3d d = normalize(axis + test::random_direction(random) * 0.03);
        pool.push_back(needle(d, 1.0));
        truth.add(d, 1.0);
    }
    reduce(pool, 3, 2e-3f);
    ASSERT_EQ(pool.size(), 2u);
    std::vector<MixtureLobe> mixture;
    for (const DirectionSums& s : pool) mixture.push_back({fit_sggx(mean_of(s)), 1.0});
    EXPECT_LT(mixture_error(mixture, truth).sigma, 0.005);
}

TEST(MomentLobes, NearlyParallelNeedlesBecomeOneLobeAndThoseTenDegreesApartStay) {
    Pool near{needle({1, .005, 0}, 1), needle({1, -.005, 0}, 1), needle({1, 0, .01}, 1)};
    reduce(near, 3, kSameLobe);
    EXPECT_EQ(near.size(), 1u);
    Pool apart{needle({1, 0, 0}, 1), needle({1, .176, 0}, 1)};
    reduce(apart, 3, kSameLobe);
    EXPECT_EQ(apart.size(), 2u);
}

TEST(MomentLobes, MaterialsStayApartUntilNothingElseIsLeft) {
    CounterRandom random{11, 5};
    for (int trial = 0; trial < 50; ++trial) {
        Pool pool = random_pool(24, 4, random);
        pool.push_back(needle({1, 0, 0}, 1e-5, 9)); // a tiny weight, and still not merged
        Pool five = pool;
        reduce(five, 5, 1e-3f);
        std::vector<std::uint32_t> materials;
        for (const DirectionSums& s : five) materials.push_back(s.material);
        std::sort(materials.begin(), materials.end());
        EXPECT_EQ(materials, (std::vector<std::uint32_t>{0, 1, 2, 3, 9}));
    }
}

TEST(MomentLobes, TheHeavierOneGivesMaterialAndKindAndTiesGoToTheLowerId) {
    DirectionSums fiber = needle({0, 0, 1}, 3.0, 5);
    DirectionSums surface = needle({1, 0, 0}, 1.0, 2);
    surface.normals = true;
    const DirectionSums tangents = merged(surface, fiber);
    EXPECT_EQ(tangents, merged(fiber, surface));
    EXPECT_EQ(tangents.material, 5u);
    EXPECT_FALSE(tangents.normals);
    // a surface with normal x has its tangents in the ring about x
    EXPECT_LT(test::difference(mean_of(tangents), {0, .125f, .875f, 0, 0, 0}), 1e-6);

    surface.weight = fiber.weight;
    EXPECT_EQ(merged(fiber, surface).material, 2u);
    EXPECT_TRUE(merged(fiber, surface).normals);
}

TEST(MomentLobes, DistanceOfFiberAndSurfaceIsTakenInTheHeaviersKind) {
    DirectionSums ring = lobe({.5f, .5f, 0, 0, 0, 0}, 1.0, 1); // normals of fibers along z
    ring.normals = true;
    Pool pool{needle({0, 0, 1}, 1.0, 2), ring, needle({0, 1, 0}, 1.0, 2)};
    const MomentLobes lobes(pool);
    EXPECT_LT(lobes.distance(0, 1), lobes.distance(1, 2) * 1e-6f);
    EXPECT_GT(lobes.distance(0, 1), lobes.distance(0, 2));
}

TEST(MomentLobes, OneLobeOrNoneIsLeftAlone) {
    Pool pool;
    EXPECT_EQ(test::reduce_lobes(pool, 3, nullptr), 0);
    pool = {needle({1, 2, 3}, 1.0)};
    EXPECT_EQ(test::reduce_lobes(pool, 3, nullptr), 1);
}

} // namespace
} // namespace heddle
