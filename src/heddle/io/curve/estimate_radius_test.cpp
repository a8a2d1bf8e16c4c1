#include <heddle/io/curve/estimate_radius.h>

#include <heddle/base/parallel.h>

#include <gtest/gtest.h>

#include <cmath>

namespace heddle {
namespace {

/// `rows` straight yarns along x, `distance` apart, with a point every 0.3.
CurveSet stripes(int rows, int points, float distance) {
    CurveSet set;
    set.first.push_back(0);
    for (int r = 0; r < rows; ++r) {
        for (int i = 0; i < points; ++i) {
            set.points.push_back(
                {0.3f * static_cast<float>(i), distance * static_cast<float>(r), 0});
        }
        set.first.push_back(set.points.size());
    }
    return set;
}

TEST(EstimateRadius, IsHalfTheDistanceOfParallelYarns) {
    for (const float distance :
         {0.01f, 0.2f, 1.0f, 30.0f}) { // from far below the distance of points to far above
        EXPECT_NEAR(estimate_radius(stripes(10, 60, distance)), 0.5f * distance, 0.001f * distance);
    }
}

TEST(EstimateRadius, OneYarnThatRunsBackAndForthIsItsOwnNeighbour) {
    CurveSet set; // rows 0.2 apart, joined by the points of half circles
    for (int row = 0; row < 20; ++row) {
        for (int i = 0; i < 50; ++i) {
            const float x = 0.21f * static_cast<float>(row % 2 == 0 ? i : 49 - i);
            set.points.push_back({x, 0.2f * static_cast<float>(row), 0});
        }
    }
    set.first = {0, set.points.size()};
    EXPECT_NEAR(estimate_radius(set), 0.1f, 0.003f);
}

TEST(EstimateRadius, IsTheMedianAndNoProbeIsItsOwnNeighbour) {
    // One yarn in 101 rows; their distance grows from 0.2 to 0.4: the median row is 0.3 from the
    // previous one. Probes that were their own neighbours, at distance 0, would move the median.
    CurveSet set;
    float y = 0.0f;
    for (int row = 0; row < 101; ++row) {
        for (int i = 0; i < 80; ++i) {
            set.points.push_back({0.217f * static_cast<float>(row % 2 == 0 ? i : 79 - i), y, 0});
        }
        y += 0.2f + 0.002f * static_cast<float>(row);
    }
    set.first = {0, set.points.size()};
    EXPECT_NEAR(estimate_radius(set), 0.15f, 0.002f);
}

TEST(EstimateRadius, ABendIsNotItsOwnNeighbour) {
    CurveSet set; // one circle: an arc is never twice as long as its chord
    for (int i = 0; i < 100; ++i) {
        const float a = 0.0628318531f * static_cast<float>(i);
        set.points.push_back({std::cos(a), std::sin(a), 0});
    }
    set.first = {0, 100};
    set.closed = {1};
    EXPECT_EQ(estimate_radius(set), 0.0f);
}

TEST(EstimateRadius, WithoutNeighboursThereIsNone) {
    EXPECT_EQ(estimate_radius({}), 0.0f);
    EXPECT_EQ(estimate_radius(stripes(1, 100, 1.0f)), 0.0f);
    CurveSet point = stripes(3, 5, 0.0f);
    for (Vec3f& p : point.points) p = {1, 1, 1};
    EXPECT_EQ(estimate_radius(point), 0.0f);
}

TEST(EstimateRadius, AFarOutlierNeitherSpoilsNorStallsIt) {
    CurveSet set = stripes(10, 60, 0.2f);
    set.points[30] = {1e30f, -1e30f, 0};
    EXPECT_GE(estimate_radius(set), 0.0f);
    set.points[30] = {500, 0, 0};
    EXPECT_NEAR(estimate_radius(set), 0.1f, 0.005f);
}

TEST(EstimateRadius, SameBitsForAnyThreadCount) {
    const CurveSet set = stripes(100, 300, 0.2f);
    set_thread_count(1);
    const float one = estimate_radius(set);
    set_thread_count(5);
    EXPECT_EQ(estimate_radius(set), one);
    set_thread_count(0);
}

} // namespace
} // namespace heddle
