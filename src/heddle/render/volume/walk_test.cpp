#include <heddle/render/volume/test_volume.h>
#include <heddle/render/volume/walk.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace heddle {
namespace {

using namespace heddle::testing;

using Index = std::tuple<int, int, int>;
struct Span {
    double t_in, t_out;
};

/// The part of a ray inside each voxel, from the planes of all of them.
std::map<Index, Span>
brute_force(const VoxelMap& voxels, const VoxelRay& ray, double t0, double t1) {
    std::map<Index, Span> out;
    for (const auto& [at, voxel] : voxels) {
        const Vec3d low{static_cast<double>(std::get<0>(at)), static_cast<double>(std::get<1>(at)),
                        static_cast<double>(std::get<2>(at))};
        Span span{t0, t1};
        for (int a = 0; a < 3; ++a) {
            if (ray.direction[a] == 0.0) {
                if (std::floor(ray.origin[a]) != low[a]) span.t_out = span.t_in; // beside it
                continue;
            }
            const double p = (low[a] - ray.origin[a]) / ray.direction[a];
            const double q = (low[a] + 1.0 - ray.origin[a]) / ray.direction[a];
            span.t_in = std::max(span.t_in, std::min(p, q));
            span.t_out = std::min(span.t_out, std::max(p, q));
        }
        if (span.t_in < span.t_out) out[at] = span;
    }
    return out;
}

/// Walks, and expects what brute force finds: all but slivers at corners, in order, once.
void expect_walk(const TraversalLevel& level,
                 const VoxelMap& voxels,
                 const VoxelRay& ray,
                 float t0,
                 float t1,
                 double near) {
    std::map<Index, Span> expected =
        brute_force(voxels, ray, static_cast<double>(t0), static_cast<double>(t1));
    std::map<Index, Span> seen;
    float last = t0;
    traverse_voxels(level, ray, t0, t1, [&](const VoxelStep& step) {
        const Index at{step.at.x, step.at.y, step.at.z};
        EXPECT_GE(step.t_in, last);
        EXPECT_GE(step.t_out, step.t_in);
        EXPECT_LE(step.t_out, t1);
        last = step.t_out;
        EXPECT_EQ(level.find_leaf(step.at).leaf, &step.leaf);
        EXPECT_EQ(step.leaf.find(step.at), step.voxel);
        const Span span{static_cast<double>(step.t_in), static_cast<double>(step.t_out)};
        EXPECT_TRUE(seen.emplace(at, span).second) << "visited twice";
        return true;
    });
    for (const auto& [at, span] : expected) {
        if (span.t_out - span.t_in < 2.0 * near) continue;
        const auto found = seen.find(at);
        ASSERT_NE(found, seen.end()) << "passed over " << std::get<0>(at);
        EXPECT_NEAR(found->second.t_in, span.t_in, near);
        EXPECT_NEAR(found->second.t_out, span.t_out, near);
    }
    for (const auto& [at, span] : seen) {
        if (span.t_out - span.t_in < 2.0 * near) continue;
        EXPECT_TRUE(expected.contains(at)) << "was not on the ray";
    }
}

VoxelMap cloud() {
    VoxelMap voxels;
    StreamRandom random{21};
    add_random(voxels, random, {-12, -12, -12}, 24, 3000, 0.9);
    add_random(voxels, random, {50, 90, -150}, 12, 200, 0.9);
    add_random(voxels, random, {-300, -64, 8}, 8, 100, 0.9);
    return voxels;
}

Vec3d index_space(StreamRandom& random, double low, double high) {
    const auto one = [&] { return low + (high - low) * static_cast<double>(random.uniform()); };
    const double x = one(), y = one();
    return {x, y, one()};
}

TEST(Walk, RandomRaysMeetWhatBruteForceFinds) {
    const VoxelMap voxels = cloud();
    const auto level = level_of(voxels);
    StreamRandom random{4};
    for (int i = 0; i < 300; ++i) {
        const Vec3d from = index_space(random, -40.0, 40.0);
        const Vec3d to = i % 3 == 0   ? Vec3d{55.0, 95.0, -145.0}
                         : i % 3 == 1 ? Vec3d{-296.0, -60.0, 12.0}
                                      : index_space(random, -10.0, 10.0);
        expect_walk(*level, voxels, {from, (to - from) * 0.01}, 0.0f, 150.0f, 3e-3);
    }
}

TEST(Walk, StartsInsideVoxels) {
    const VoxelMap voxels = cloud();
    const auto level = level_of(voxels);
    StreamRandom random{6};
    for (int i = 0; i < 300; ++i) {
        const Vec3d from = index_space(random, -12.0, 12.0);
        const VoxelRay ray{from, to_double(random_direction(random))};
        expect_walk(*level, voxels, ray, 0.0f, 30.0f, 2e-5);
        expect_walk(*level, voxels, ray, 3.25f, 7.5f, 2e-5);
    }
}

TEST(Walk, RaysAlongAnAxisPassEachVoxelInTurn) {
    const VoxelMap voxels = cloud();
    const auto level = level_of(voxels);
    StreamRandom random{8};
    for (int i = 0; i < 200; ++i) {
        Vec3d from = index_space(random, -14.0, 14.0);
        Vec3d along{};
        along[i % 3] = i % 2 == 0 ? 1.0 : -1.0;
        if (i % 5 == 0) from = {std::floor(from.x), std::floor(from.y), std::floor(from.z)};
        expect_walk(*level, voxels, {from, along}, 0.0f, 400.0f, 2e-4);
    }
}

TEST(Walk, StartsExactlyOnFaces) {
    const VoxelMap voxels = cloud();
    const auto level = level_of(voxels);
    StreamRandom random{10};
    for (int i = 0; i < 300; ++i) {
        Vec3d from = index_space(random, -12.0, 12.0);
        for (int a = 0; a <= i % 3; ++a) from[a] = std::round(from[a]);
        const VoxelRay ray{from, to_double(random_direction(random))};
        expect_walk(*level, voxels, ray, 0.0f, 30.0f, 2e-5);
    }
}

TEST(Walk, DirectionsNeedNotBeUnit) { // voxels that are no cubes, and small scene units
    const VoxelMap voxels = cloud();
    const auto level = level_of(voxels);
    StreamRandom random{12};
    for (int i = 0; i < 200; ++i) {
        const Vec3d from = index_space(random, -30.0, 30.0);
        const Vec3d d = to_double(random_direction(random)) * Vec3d{400.0, 25.0, 90.0};
        expect_walk(*level, voxels, {from, d}, 0.0f, 1.0f, 2e-6);
    }
}

TEST(Walk, LengthsTileTheRay) { // through a block without gaps
    VoxelMap voxels;
    for (int i = 0; i < 20 * 20 * 20; ++i) {
        voxels[{i % 20 - 10, i / 20 % 20 - 10, i / 400 - 10}] =
            even_voxel(0.5, {{needle({1, 0, 0}), 255, 0}});
    }
    const auto level = level_of(voxels);
    StreamRandom random{14};
    for (int i = 0; i < 200; ++i) {
        const VoxelRay ray{index_space(random, -3.0, 3.0), to_double(random_direction(random))};
        float at = 0.0f;
        traverse_voxels(*level, ray, 0.0f, 6.5f, [&](const VoxelStep& step) {
            EXPECT_EQ(step.t_in, at);
            at = step.t_out;
            return true;
        });
        EXPECT_EQ(at, 6.5f);
    }
}

TEST(Walk, EndsWhereTheVisitorSaysSo) {
    const VoxelMap voxels = cloud();
    const auto level = level_of(voxels);
    int count = 0;
    traverse_voxels(*level, {{-20.0, 0.3, 0.4}, {1.0, 0.01, 0.02}}, 0.0f, 100.0f,
                    [&](const VoxelStep&) { return ++count < 3; });
    EXPECT_EQ(count, 3);
}

} // namespace
} // namespace heddle
