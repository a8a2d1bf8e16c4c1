#include <heddle/raster/voxelize_slices.h>

#include <heddle/base/error.h>
#include <heddle/geom/generate.h>
#include <heddle/raster/brick_grid.h>
#include <heddle/raster/brick_words.h>
#include <heddle/raster/test_difference.h>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <optional>
#include <string>

namespace heddle::raster {
namespace {

using namespace heddle::raster::test;
using namespace heddle::slice::test;

VoxelizeOptions options_of(double voxel_size) {
    VoxelizeOptions options;
    options.voxel_size = {voxel_size, voxel_size, voxel_size};
    options.keep_sums = true;
    return options;
}

std::unique_ptr<VoxelLevel> draw(const Geometry& geometry,
                                 const VoxelizeOptions& options,
                                 Composition composition = Composition::Accumulate) {
    Progress silent;
    return voxelize_slices(geometry, options, {.composition = composition},
                           plan_voxelize(geometry, options), silent);
}

Difference difference_of(const Geometry& geometry, const VoxelizeOptions& options) {
    return compare(*heddle::test::voxelize_now(geometry, options), *draw(geometry, options));
}

void expect_close(const Difference& d, const std::string& what) {
    EXPECT_NEAR(d.density, 1.0, 0.03) << what;
    EXPECT_NEAR(d.coverage, 1.0, 0.03) << what;
    EXPECT_NEAR(d.volume, 1.0, 0.03) << what;
    EXPECT_LT(d.angle_deg, 5.0) << what;
}

Geometry weave(GenerateKind kind, std::int64_t nx, std::int64_t ny) {
    return generate({.kind = kind, .nx = nx, .ny = ny});
}

double radius_of(const Geometry& geometry) {
    return static_cast<double>(geometry.curves[0].default_radius);
}

TEST(VoxelizeSlices, AStraightYarnIsAsSampledAtTwentyAngles) {
    for (int k = 0; k < 20; ++k) { // from along x to along y and up to along z
        const double a = 1.5707963 * k / 19.0;
        const double up = k % 2 == 0 ? 0.0 : 1.5707963 * k / 19.0;
        const Vec3f direction =
            to_float({std::cos(a) * std::cos(up), std::sin(a) * std::cos(up), std::sin(up)});
        const Geometry yarn = straight_yarn(direction, slice_yarn(0.06f));
        expect_close(difference_of(yarn, options_of(0.03)), "angle " + std::to_string(k));
    }
}

TEST(VoxelizeSlices, SatinAndACableAreAsSampled) {
    for (const GenerateKind kind : {GenerateKind::Satin, GenerateKind::Cable}) {
        const bool satin = kind == GenerateKind::Satin;
        Geometry cloth = satin ? weave(kind, 5, 5) : weave(kind, 8, 3);
        set_yarn(cloth, slice_yarn(0.0f, 60));
        const double voxel = radius_of(cloth) / (satin ? 3.0 : 2.0);
        expect_close(difference_of(cloth, options_of(voxel)), satin ? "satin" : "cable");
    }
}

TEST(VoxelizeSlices, HairAndFlatVoxelsAreAsSampled) {
    Geometry hair = generate({.kind = GenerateKind::Hair, .nx = 20, .ny = 8});
    VoxelizeOptions options;
    options.voxels = 64;
    options.keep_sums = true;
    expect_close(difference_of(hair, options), "hair");
    const Geometry yarn = straight_yarn({0.8f, 0.5f, 0.33f}, slice_yarn(0.06f));
    options = options_of(0.03);
    options.voxel_size.z = 0.01;
    expect_close(difference_of(yarn, options), "flat");
    options = options_of(0.015);
    options.subvoxels = 4;
    expect_close(difference_of(yarn, options), "four subvoxels");
}

TEST(VoxelizeSlices, TheSameBitsOnEveryRunInEveryOrderAndBatch) {
    const Geometry cloth = weave(GenerateKind::Plain, 6, 6); // of solid yarns
    const VoxelizeOptions options = options_of(radius_of(cloth) / 2.0);
    const std::vector<Stored> first = stored(*draw(cloth, options));
    ASSERT_GT(first.size(), 1000u);
    EXPECT_EQ(stored(*draw(cloth, options)), first);

    Geometry turned = cloth; // the last curve first
    CurveSet& set = turned.curves[0];
    const CurveSet& from = cloth.curves[0];
    set.points.clear();
    set.first.assign(1, 0);
    for (std::size_t c = from.curve_count(); c-- > 0;) {
        const auto at = [&](std::size_t i) {
            return from.points.begin() + static_cast<std::ptrdiff_t>(from.first[i]);
        };
        set.points.insert(set.points.end(), at(c), at(c + 1));
        set.first.push_back(set.points.size());
    }
    EXPECT_EQ(stored(*draw(turned, options)), first);

    const VoxelizePlan plan = plan_voxelize(cloth, options);
    Progress silent;
    VoxelizeOptions small = options;
    small.memory_bytes = 1; // the plan is made without: a block a batch
    RasterCounts counts;
    EXPECT_EQ(stored(*voxelize_slices(cloth, small, {}, plan, silent, nullptr, &counts)), first);
    EXPECT_GT(counts.batches, 1);
}

TEST(VoxelizeSlices, FramesInOneVoxelizerHaveTheBitsOfEachAlone) {
    const VoxelizeOptions options = options_of(0.03);
    Geometry two = straight_yarn({0.8f, 0.5f, 0.33f}, slice_yarn(0.06f));
    two.curves.push_back(straight_yarn({0.1f, 0.5f, -0.8f}, slice_yarn(0.06f)).curves[0]);
    two.curves[1].yarn = 0;
    const Geometry frames[] = {straight_yarn({0.8f, 0.5f, 0.33f}, slice_yarn(0.06f)),
                               straight_yarn({0.3f, -0.5f, 0.7f}, slice_yarn(0.06f)),
                               straight_yarn({0.3f, -0.5f, 0.7f}, slice_yarn(0.05f, 60)), two};
    SliceVoxelizer voxelizer({});
    Progress silent;
    for (const Geometry& frame : frames) {
        const std::vector<Stored> alone = stored(*draw(frame, options)); // in a context of its own
        ASSERT_GT(alone.size(), 100u);
        const VoxelizePlan plan = plan_voxelize(frame, options);
        EXPECT_TRUE(stored(*voxelizer.voxelize(frame, options, plan, silent)) == alone);
    }
}

TEST(VoxelizeSlices, ARegionHasTheSameBitsAsTheWhole) {
    const Geometry yarn = straight_yarn({0.7f, 0.5f, -0.5f}, slice_yarn(0.06f));
    VoxelizeOptions options = options_of(0.03);
    const std::vector<Stored> whole = stored(*draw(yarn, options));
    options.bounds = Bounds{{-0.1, -0.1, -0.2}, {0.2, 0.2, 0.05}};
    const std::vector<Stored> part = stored(*draw(yarn, options));
    ASSERT_GT(part.size(), 50u);
    ASSERT_LT(part.size(), whole.size());
    for (const Stored& v : part) {
        EXPECT_NE(std::find(whole.begin(), whole.end(), v), whole.end());
    }
}

TEST(VoxelizeSlices, TwoMaterialsKeepTheirLobes) {
    Geometry yarns = straight_yarn({1.0f, 0.0f, 0.0f}, slice_yarn(0.06f));
    yarns.materials.push_back(yarns.materials[0]);
    CurveSet other = straight_yarn({0.0f, 1.0f, 0.0f}, slice_yarn(0.06f)).curves[0];
    other.material = 1;
    other.yarn = 0;
    yarns.curves.push_back(other);
    int both = 0;
    const std::unique_ptr<VoxelLevel> drawn = draw(yarns, options_of(0.03));
    for_each_voxel(*drawn, [&](const BlockVoxel& v) { both += v.lobes().size() == 2 ? 1 : 0; });
    EXPECT_GT(both, 10);
    expect_close(difference_of(yarns, options_of(0.03)), "crossing");
}

TEST(Composition, DensitiesStandInTheOrderOfTheirPolicies) {
    YarnType full = slice_yarn(0.1f);
    for (std::size_t i = 3; i < full.slice.texels.size(); i += 4) {
        full.slice.texels[i] = i % 16 == 3 ? 255 : 51; // a row of texels: 255, 51, 51, 51
    }
    const Geometry yarn = straight_yarn({0.9f, 0.3f, 0.2f}, full);
    const VoxelizeOptions options = options_of(0.03);
    const auto mean = [&](Composition composition) {
        double sum = 0.0;
        double count = 0.0;
        for_each_voxel(*draw(yarn, options, composition), [&](const BlockVoxel& v) {
            EXPECT_EQ(v.coverage().x, v.coverage().y);
            sum += heddle::test::covered(v.coverage(), 0);
            count += 1.0;
        });
        return sum / count;
    };
    const double last = mean(Composition::Last);
    const double average = mean(Composition::Average);
    EXPECT_GT(mean(Composition::Max), 0.95);
    EXPECT_LT(average, 0.42); // 0.4 inside, less at transparent corners
    EXPECT_GT(average, 0.3);
    EXPECT_GT(last, 0.3); // any one of them
    EXPECT_LT(last, 0.5);
    EXPECT_EQ(stored(*draw(yarn, options, Composition::Last)),
              stored(*draw(yarn, options, Composition::Last)));
}

TEST(VoxelizeSlices, WhatCannotBeDrawnIsOneLine) {
    Progress silent;
    const auto code = [&](const Geometry& geometry, const VoxelizeOptions& options) {
        try {
            (void)draw(geometry, options);
        } catch (const Error& e) {
            EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
            return std::optional(e.code());
        }
        return std::optional<ErrorCode>();
    };
    VoxelizeOptions options;
    options.voxels = 32;
    EXPECT_EQ(code(generate({.kind = GenerateKind::Grass, .nx = 4, .ny = 4}), options),
              ErrorCode::Unsupported);
    Geometry plied = straight_yarn({1.0f, 0.0f, 0.0f}, slice_yarn(0.06f));
    plied.yarns[0].model = YarnModel::Procedural;
    EXPECT_EQ(code(plied, options), ErrorCode::Unsupported);
    VoxelizeOptions fine = options_of(0.0004); // a radius of 1200 subvoxels
    fine.bounds = Bounds{{0.0, 0.0, 0.0}, {0.001, 0.001, 0.001}};
    EXPECT_EQ(code(straight_yarn({1.0f, 0.0f, 0.0f}, slice_yarn(0.06f)), fine),
              ErrorCode::Unsupported);
    // more subvoxels than pixels can number, more bricks than a table
    const LatticeUnits units(Lattice{});
    EXPECT_THROW(BrickGrid(units, {}, {600000, 0, 0}, {600001, 1, 1}), Error);
    EXPECT_THROW(BrickGrid(units, {}, {}, {4000, 4000, 4000}), Error);
    EXPECT_NO_THROW(BrickGrid(units, {}, {}, {2048, 2048, 2048}));
}

TEST(VoxelizeSlices, AYarnWithoutLengthBesideOthersLeavesNothing) {
    Geometry yarns = straight_yarn({0.9f, 0.3f, 0.2f}, slice_yarn(0.06f));
    const VoxelizeOptions options = options_of(0.03);
    const std::unique_ptr<VoxelLevel> alone = draw(yarns, options);
    const Vec3f p = yarns.curves[0].points[1];
    heddle::test::add_curve(yarns.curves[0], {p, p, p, p});
    const Difference d = compare(*alone, *draw(yarns, options));
    EXPECT_NEAR(d.volume, 1.0, 0.01); // its fibers made the sections' images finer
    EXPECT_NEAR(d.coverage, 1.0, 0.01);
}

TEST(SpreadColumns, HaveAsManyBitsAsAskedAndGrowBySupersets) {
    for (const int n : {1, 2, 4, 8}) {
        std::uint64_t last = 0;
        for (int count = 0; count <= n * n; ++count) {
            const std::uint64_t bits = spread_columns(count, n);
            EXPECT_EQ(std::popcount(bits), count);
            EXPECT_EQ(bits & last, last);
            last = bits;
        }
    }
    // half of the columns in every row
    for (int row = 0; row < 8; ++row) {
        EXPECT_EQ(std::popcount(spread_columns(32, 8) >> (8 * row) & 0xffu), 4) << row;
    }
}

} // namespace
} // namespace heddle::raster
