#include <heddle/render/embree/test_trace.h>
#include <heddle/render/embree/yarn_curves.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace heddle {
namespace {

using namespace heddle::test;

/// Three plies, twisted against each other, with migrating fibers.
YarnType plied_yarn(int fibers_per_ply) {
    YarnType yarn;
    yarn.name = "plied";
    yarn.model = YarnModel::Procedural;
    yarn.plies = 3;
    yarn.fibers_per_ply = fibers_per_ply;
    yarn.fiber_clockwise = true;
    yarn.fiber_radius = 0.04f;
    yarn.ply_pitch = 8.0f;
    yarn.fiber_pitch = 6.0f;
    yarn.ply_offset = 0.5f;
    yarn.ellipse_long = 0.5f;
    yarn.ellipse_short = 0.4f;
    yarn.migration = true;
    yarn.migration_min = 0.8f;
    yarn.migration_max = 1.0f;
    return yarn;
}

/// A bent yarn of radius 0.5 about the x axis, from x = 0 to 8.
Geometry bent_yarn(const YarnType& yarn, bool closed = false) {
    CurveSet set;
    set.basis = Basis::CatmullRom;
    set.default_radius = 0.5f;
    std::vector<Vec3f> points;
    for (int i = -1; i <= 9; ++i) {
        const auto x = static_cast<float>(i);
        const float a = 0.571f * x;
        points.push_back(closed ? Vec3f{2.0f * std::cos(a), 2.0f * std::sin(a), 0.3f * std::sin(a)}
                                : Vec3f{x, 0.6f * std::sin(x), 0.4f * std::cos(1.3f * x)});
    }
    add_curve(set, points, closed);
    Geometry geometry = geometry_of(set);
    geometry.yarns.push_back(yarn);
    geometry.curves[0].yarn = 0;
    return geometry;
}

/// Mean coverage of the voxels' faces along `axis`, over all voxels, and the same by rays.
struct Coverages {
    double voxels = 0.0, rays = 0.0;
    std::int64_t count = 0;
};

bool blocked(const SurfaceScene& scene, Vec3d lo, double edge, int axis, double u, double v) {
    Ray ray;
    ray.origin = lo;
    ray.origin[(axis + 1) % 3] += u * edge;
    ray.origin[(axis + 2) % 3] += v * edge;
    ray.direction = {};
    ray.direction[axis] = 1.0f;
    ray.t_max = static_cast<float>(edge);
    if (scene.occluded(ray)) return true;
    // what covers the face may hold the ray's start: it is seen from the other end
    ray.origin[axis] += edge;
    ray.direction[axis] = -1.0f;
    return scene.occluded(ray);
}

Coverages compare(const Geometry& geometry, double edge, int axis) {
    constexpr int kRays = 16;
    VoxelizeOptions options;
    options.voxel_size = {edge, edge, edge};
    const auto grid = voxelize_now(geometry, options);
    const auto scene = trace(geometry);
    Coverages sum;
    for_each_voxel(*grid, [&](const BlockVoxel& voxel) {
        const Vec3d lo{voxel.at.x * edge, voxel.at.y * edge, voxel.at.z * edge};
        sum.voxels += covered(voxel.coverage(), axis);
        int hits = 0;
        for (int i = 0; i < kRays * kRays; ++i) {
            const double u = (i % kRays + 0.5) / kRays;
            const double v = (i / kRays + 0.5) / kRays;
            hits += blocked(*scene, lo, edge, axis, u, v) ? 1 : 0;
        }
        sum.rays += static_cast<double>(hits) / (kRays * kRays);
        ++sum.count;
    });
    return sum;
}

void expect_same_coverage(const Geometry& geometry, double edge) {
    for (int axis = 0; axis < 3; ++axis) {
        SCOPED_TRACE(axis);
        const Coverages c = compare(geometry, edge, axis);
        EXPECT_GT(c.count, 100);
        EXPECT_NEAR(c.rays / c.voxels, 1.0, 0.01) << c.rays << " of " << c.voxels;
    }
}

/// Which columns of 8 x 8 a voxel's face are blocked along `axis`, seen through the whole object.
using Silhouette = std::map<std::array<int, 2>, std::uint64_t>;

Silhouette silhouette_of(const Geometry& geometry, double edge, int axis) {
    VoxelizeOptions options;
    options.voxel_size = {edge, edge, edge};
    options.keep_sums = true;
    const auto grid = voxelize_now(geometry, options);
    Silhouette out;
    for_each_voxel(*grid, [&](const BlockVoxel& voxel) {
        out[{voxel.at[axis == 0 ? 1 : 0], voxel.at[axis == 2 ? 1 : 2]}] |=
            voxel.columns()[static_cast<std::size_t>(axis)];
    });
    return out;
}

// Column by column: rays meet what the voxelizer found there.
void expect_same_silhouette(const Geometry& geometry, double edge) {
    const auto scene = trace(geometry);
    for (int axis = 0; axis < 3; ++axis) {
        SCOPED_TRACE(axis);
        int blocked = 0, differ = 0;
        for (const auto& [at, bits] : silhouette_of(geometry, edge, axis)) {
            for (int i = 0; i < 64; ++i) {
                Ray ray;
                ray.origin[axis] = -20.0;
                ray.origin[axis == 0 ? 1 : 0] = edge * (at[0] + (i % 8 + 0.5) / 8.0);
                ray.origin[axis == 2 ? 1 : 2] = edge * (at[1] + (i / 8 + 0.5) / 8.0);
                ray.direction[axis] = 1.0f;
                const bool met = scene->occluded(ray);
                blocked += met ? 1 : 0;
                differ += met != ((bits >> i & 1u) != 0) ? 1 : 0;
            }
        }
        EXPECT_GT(blocked, 1000);
        EXPECT_LT(differ, 0.02 * blocked) << blocked; // at edges
    }
}

TEST(EmbreeYarn, FibersStandWhereTheVoxelizerFindsThem) {
    expect_same_silhouette(bent_yarn(plied_yarn(12)), 0.25);
    expect_same_silhouette(bent_yarn(plied_yarn(12), true), 0.25);
}

TEST(EmbreeYarn, RaysAreStoppedAsVoxelsAreCovered) {
    expect_same_coverage(bent_yarn(plied_yarn(12)), 0.25);
}

TEST(EmbreeYarn, ClosedYarnsAreStoppedAsVoxelsAreCovered) {
    expect_same_coverage(bent_yarn(plied_yarn(12), true), 0.25);
}

TEST(EmbreeYarn, FlyawaysAreTheVoxelizers) {
    YarnType yarn = plied_yarn(2);
    yarn.flyaways = true;
    yarn.hair_density = 4.0f;
    yarn.hair_ze = {0.5f, 0.5f};
    yarn.hair_r0 = {0.4f, 0.1f};
    yarn.hair_re = {0.8f, 0.2f};
    yarn.hair_pe = {0.5f, 0.4f};
    yarn.loop_density = 1.0f;
    yarn.loop_r1 = {1.0f, 0.1f};
    expect_same_coverage(bent_yarn(yarn), 0.25);
}

TEST(EmbreeYarn, SlicesFibersHaveItsColours) {
    YarnType yarn;
    yarn.model = YarnModel::Slice;
    yarn.slice_fibers = 60;
    yarn.twist = 0.0f;
    yarn.slice.width = 2;
    yarn.slice.height = 1;
    yarn.slice.channels = 4;
    yarn.slice.texels = {255, 0, 0, 255, 0, 255, 0, 255};
    const auto scene = trace(bent_yarn(yarn));
    StreamRandom random{2};
    int red = 0, green = 0;
    for (int i = 0; i < 2000; ++i) {
        TracedHit hit;
        const Vec3d at{1.0 + 6.0 * static_cast<double>(random.uniform()), 0.0, 0.0};
        if (!scene->intersect(ray_to(at + 4.0 * draw_direction(random), at), hit)) continue;
        const Vec3f albedo = hit.scatterer.material.albedo;
        EXPECT_TRUE((albedo == Vec3f{0.8f, 0, 0}) || (albedo == Vec3f{0, 0.8f, 0}));
        (albedo.x > 0.0f ? red : green) += 1;
    }
    EXPECT_GT(red, 300);
    EXPECT_GT(green, 300);
    expect_same_silhouette(bent_yarn(yarn), 0.25);
}

TEST(EmbreeYarn, SolidYarnsAreOneFiber) {
    YarnType yarn;
    yarn.model = YarnModel::Solid;
    // closed: the ends of an open cubic are open, which shows where a fiber is as thick as a yarn
    expect_same_silhouette(bent_yarn(yarn, true), 0.25);
}

TEST(EmbreeYarn, MoreCubicsAreCloser) {
    const Geometry geometry = bent_yarn(plied_yarn(12));
    const FiberSource source(geometry, std::numeric_limits<double>::infinity(), 0);
    const double one = cubic_error(source, {}, 1);
    const double two = cubic_error(source, {}, 2);
    EXPECT_LT(two, 0.25 * one);
    EXPECT_GT(one, 0.03); // else the choice below has nothing to do
    const int cubics = choose_cubics(source, {}, 0.03f);
    EXPECT_GT(cubics, 1);
    EXPECT_LE(cubic_error(source, {}, cubics), 0.03);
    EXPECT_EQ(count_yarn_segments(source, {}, cubics),
              36u * 8u * static_cast<std::uint64_t>(cubics));
}

TEST(EmbreeYarn, ShortMemoryMeansFewerCubics) {
    const Geometry geometry = bent_yarn(plied_yarn(200));
    EmbreeOptions options;
    const std::int64_t whole = trace(geometry, {}, {Affine{}}, options)->byte_count();
    options.memory_bytes = 4800 * 160;
    EXPECT_LT(trace(geometry, {}, {Affine{}}, options)->byte_count(), whole);
    options.memory_bytes = 4800 * 50;
    EXPECT_THROW(static_cast<void>(trace(geometry, {}, {Affine{}}, options)), Error);
}

TEST(EmbreeYarn, YarnsWithoutLengthDoNoHarm) {
    Geometry geometry = bent_yarn(plied_yarn(4));
    for (Vec3f& p : geometry.curves[0].points) p = {1.0f, 2.0f, 3.0f};
    const auto scene = trace(geometry);
    EXPECT_FALSE(scene->occluded(ray_to({5, 5, 5}, {5, 5, 4})));
}

} // namespace
} // namespace heddle
