#include <heddle/voxel/plane_slab.h>

#include <heddle/base/random.h>
#include <heddle/voxel/parent_slab.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace heddle {
namespace {

constexpr Vec3d kEdges{0.3, 1.1, 0.6};

double number(CounterRandom& random) {
    return static_cast<double>(random.next() >> 11) * 0x1p-53;
}

Vec3d direction(CounterRandom& random) {
    const auto one = [&] { return 2.0 * number(random) - 1.0; };
    const double x = one();
    const double y = one();
    return normalize(Vec3d{x, y, one()});
}

PlaneSlab slab(CounterRandom& random) {
    const auto a = static_cast<std::uint8_t>(random.next() % 256);
    const auto b = static_cast<std::uint8_t>(random.next() % 256);
    return {std::min(a, b), std::max(a, b)};
}

/// Returns the corners of a voxel between its planes: its own corners there, and the points where
/// a plane crosses an edge.
std::vector<Vec3d> corners_between(Vec3d gradient, const PlaneSlab& slab) {
    std::vector<Vec3d> out;
    const auto inside = [&](Vec3d p) {
        const double v = slab_value(gradient, p);
        if (v >= slab.lo - 1e-9 && v <= slab.hi + 1e-9) out.push_back(p);
    };
    for (int c = 0; c < 8; ++c) {
        const Vec3d p{(c >> 2) - 0.5, (c >> 1 & 1) - 0.5, (c & 1) - 0.5};
        inside(p);
        for (int a = 0; a < 3; ++a) {
            if ((c >> (2 - a) & 1) != 0 || gradient[a] == 0.0) continue;
            for (const double plane : {1.0 * slab.lo, 1.0 * slab.hi}) {
                Vec3d q = p;
                q[a] += (plane - slab_value(gradient, p)) / gradient[a];
                if (std::fabs(q[a]) <= 0.5) inside(q);
            }
        }
    }
    return out;
}

double brute_support(Vec3d gradient, const PlaneSlab& slab, Vec3d along) {
    double most = -1e300;
    for (const Vec3d& p : corners_between(gradient, slab)) most = std::max(most, dot(along, p));
    return most;
}

TEST(PlaneSlab, ValueIsThePositionAlongTheNormal) {
    CounterRandom random{3, 0};
    for (int i = 0; i < 200; ++i) {
        const Vec3d n = direction(random);
        const double s = slab_half_extent(n, kEdges);
        const Vec3d gradient = slab_gradient(n, kEdges);
        EXPECT_NEAR(slab_value(gradient,
                               {n.x < 0 ? -0.5 : 0.5, n.y < 0 ? -0.5 : 0.5, n.z < 0 ? -0.5 : 0.5}),
                    255.0, 1e-9);
        const Vec3d p{number(random) - 0.5, number(random) - 0.5, number(random) - 0.5};
        const double value = slab_value(gradient, p);
        EXPECT_NEAR(dot(n, p * kEdges), (value / 255.0 * 2.0 - 1.0) * s, 1e-12);
        const std::uint8_t v = round_slab_value(value);
        EXPECT_LE(std::fabs(slab_position(v, s) - dot(n, p * kEdges)), s / 255.0 + 1e-12);
    }
    EXPECT_EQ(round_slab_value(-3.0), 0);
    EXPECT_EQ(round_slab_value(300.0), 255);
}

TEST(PlaneSlab, OnlyTheRatiosOfTheEdgesCount) {
    const Vec3d n = normalize(Vec3d{0.3, -0.7, 0.2});
    EXPECT_EQ(slab_gradient(n, kEdges), slab_gradient(n, kEdges * 8.0));
}

TEST(PlaneSlab, NormalsAreKeptTo0Point6DegreesAndAxesExactly) {
    CounterRandom random{9, 0};
    double least = 1.0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3d n = direction(random);
        const PackedNormal packed = pack_normal(n);
        EXPECT_EQ(packed, pack_normal(unpack_normal(packed)));
        EXPECT_NEAR(length(unpack_normal(packed)), 1.0, 1e-12);
        least = std::min(least, std::fabs(dot(n, unpack_normal(packed))));
    }
    EXPECT_GT(least, std::cos(0.6 * 3.14159265 / 180.0));
    for (const Vec3d axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
        EXPECT_EQ(unpack_normal(pack_normal(axis)), axis);
        EXPECT_NEAR(std::fabs(dot(unpack_normal(pack_normal(axis * -1.0)), axis)), 1.0, 1e-12);
    }
}

TEST(PlaneSlab, MainNormalIsThatOfTheLargestArea) {
    std::int64_t moment[6] = {};
    const Vec3d n = normalize(Vec3d{0.2, -0.9, 0.4});
    add_area_moment(n * 0.3, moment);
    add_area_moment(n * -0.2, moment);
    add_area_moment(cross(n, {0, 0, 1}) * 0.1, moment);
    EXPECT_GT(std::fabs(dot(n, unpack_normal(main_normal(moment)))), 0.9999);
}

TEST(PlaneSlab, ARangeIsThatOfTheVoxelBetweenItsPlanes) {
    CounterRandom random{5, 0};
    for (int i = 0; i < 5000; ++i) {
        Vec3d n = direction(random);
        Vec3d along = direction(random);
        if (i % 5 == 0) n[static_cast<int>(random.next() % 3)] = 0.0;
        if (i % 7 == 0) along[static_cast<int>(random.next() % 3)] = 0.0;
        const Vec3d gradient = slab_gradient(normalize(n), kEdges);
        if (i % 3 == 0) along = gradient * (i % 2 == 0 ? 1.0 : -1.0);
        const PlaneSlab planes = i % 4 == 0 ? PlaneSlab{} : slab(random);
        const SlabRange range = range_between(gradient, planes, along);
        const double close = 1e-9 * (1.0 + length(along));
        EXPECT_NEAR(range.max, brute_support(gradient, planes, along), close) << i;
        EXPECT_NEAR(range.min, -brute_support(gradient, planes, along * -1.0), close) << i;
    }
}

TEST(PlaneSlab, ParentHoldsItsChildrenAndNoMore) {
    CounterRandom random{7, 0};
    for (int i = 0; i < 500; ++i) {
        ParentSlab joined{slab_gradient(direction(random), kEdges)};
        EXPECT_EQ(joined.slab(), PlaneSlab{}) << "no child says nothing";
        double min = 255.0;
        double max = 0.0;
        for (int octant = 0; octant < 8; ++octant) {
            if (random.next() % 2 == 0) continue;
            const Vec3d gradient = slab_gradient(direction(random), kEdges);
            const PlaneSlab planes = slab(random);
            joined.add(octant, gradient, planes);
            for (const Vec3d& p : corners_between(gradient, planes)) {
                const Vec3d corner{(octant >> 2) - 0.5, (octant >> 1 & 1) - 0.5,
                                   (octant & 1) - 0.5};
                const double v = slab_value(joined.gradient, (corner + p) * 0.5);
                min = std::min(min, v);
                max = std::max(max, v);
            }
        }
        if (min > max) continue;
        EXPECT_NEAR(joined.slab().lo, min, 0.5 + 1e-6);
        EXPECT_NEAR(joined.slab().hi, max, 0.5 + 1e-6);
    }
}

TEST(PlaneSlab, FlatChildrenGiveAFlatParent) {
    const Vec3d gradient = slab_gradient(normalize(Vec3d{0.3, 0.5, 0.8}), kEdges);
    for (int plane = 0; plane < 256; ++plane) { // one plane of the parent, in each child it crosses
        ParentSlab joined{gradient};
        for (int octant = 0; octant < 8; ++octant) {
            const Vec3d center{(octant >> 2) * 0.5 - 0.25, (octant >> 1 & 1) * 0.5 - 0.25,
                               (octant & 1) * 0.5 - 0.25};
            const double v = 127.5 + 2.0 * (plane - slab_value(gradient, center));
            if (v < -0.4 || v > 255.4) continue;
            const std::uint8_t at = round_slab_value(v);
            joined.add(octant, gradient, {at, at});
        }
        EXPECT_NEAR(joined.slab().lo, plane, 1.0);
        EXPECT_NEAR(joined.slab().hi, plane, 1.0);
    }
}

} // namespace
} // namespace heddle
