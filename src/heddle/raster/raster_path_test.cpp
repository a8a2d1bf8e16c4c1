#include <heddle/geom/generate.h>
#include <heddle/raster/rasterize_bricks.h>
#include <heddle/raster/test_difference.h>
#include <heddle/raster/voxelize_slices.h>

#include <gtest/gtest.h>

#include <string>

namespace heddle::raster {
namespace {

using namespace heddle::raster::test;
using namespace heddle::slice::test;

constexpr Composition kCompositions[] = {Composition::Last, Composition::Average, Composition::Max,
                                         Composition::Accumulate};

VoxelizeOptions options_of(double voxel_size) {
    VoxelizeOptions options;
    options.voxel_size = {voxel_size, voxel_size, voxel_size};
    options.keep_sums = true;
    return options;
}

Geometry tilted_yarn() {
    return straight_yarn({0.8f, 0.5f, 0.33f}, slice_yarn(0.06f));
}

std::vector<Stored> draw(const Geometry& geometry,
                         const VoxelizeOptions& options,
                         const RasterOptions& raster,
                         std::int64_t batches = 1) {
    const VoxelizePlan plan = plan_voxelize(geometry, options);
    VoxelizeOptions small = options;
    if (batches > 1) small.memory_bytes = 1; // the plan is made without: a block a batch
    RasterCounts counts;
    Progress silent;
    std::vector<Stored> out =
        stored(*voxelize_slices(geometry, small, raster, plan, silent, nullptr, &counts));
    EXPECT_EQ(counts.path, raster.path);
    EXPECT_GE(counts.batches, batches);
    return out;
}

void expect_same(const Geometry& geometry,
                 const VoxelizeOptions& options,
                 const std::string& what,
                 Composition composition = Composition::Accumulate,
                 std::int64_t batches = 1) {
    const auto by = [&](RasterPath path) {
        return draw(geometry, options, {.composition = composition, .path = path}, batches);
    };
    const std::vector<Stored> drawn = by(RasterPath::Fragment);
    EXPECT_GT(drawn.size(), 100u) << what;
    EXPECT_TRUE(drawn == by(RasterPath::Compute)) << what; // not EQ: it would print them all
}

TEST(RasterPath, BothGiveTheSameBitsOfSegmentsThatAreManyDispatches) {
    // 120 subvoxels of radius: up to 10000 pixels a segment, with 150 fibers to be passed by each
    const Geometry yarn = straight_yarn({0.8f, 0.5f, 0.33f}, slice_yarn(0.15f, 150));
    VoxelizeOptions options = options_of(0.01);
    options.bounds = Bounds{{0.0, -1.0, -1.0}, {0.3, 1.0, 1.0}};
    expect_same(yarn, options, "thick");
}

TEST(RasterPath, BothGiveTheSameBitsInEveryComposition) {
    const Geometry yarn = tilted_yarn();
    Geometry cloth = generate({.kind = GenerateKind::Satin, .nx = 5, .ny = 5});
    set_yarn(cloth, slice_yarn(0.0f, 60));
    const double radius = static_cast<double>(cloth.curves[0].default_radius);
    for (const Composition composition : kCompositions) {
        const std::string name = std::to_string(static_cast<int>(composition));
        expect_same(yarn, options_of(0.03), "yarn " + name, composition);
        expect_same(cloth, options_of(radius / 2.0), "satin " + name, composition);
    }
}

TEST(RasterPath, BothGiveTheSameBitsAlongTheAxesAndOfHair) {
    for (const Vec3f along : {Vec3f{1.0f, 0.0f, 0.0f}, Vec3f{0.0f, 1.0f, 0.0f},
                              Vec3f{0.0f, 0.0f, 1.0f}, Vec3f{0.7071068f, -0.7071068f, 0.0f}}) {
        expect_same(straight_yarn(along, slice_yarn(0.06f)), options_of(0.03), "axis");
    }
    VoxelizeOptions options;
    options.voxels = 96;
    options.keep_sums = true;
    expect_same(generate({.kind = GenerateKind::Hair, .nx = 20, .ny = 8}), options, "hair");
}

TEST(RasterPath, BothGiveTheSameBitsOfFlatVoxelsRegionsAndBatches) {
    const Geometry yarn = tilted_yarn();
    VoxelizeOptions flat = options_of(0.03);
    flat.voxel_size.z = 0.01;
    VoxelizeOptions coarse = options_of(0.015);
    coarse.subvoxels = 4;
    VoxelizeOptions region = options_of(0.02);
    region.bounds = Bounds{{-0.2, -0.2, -0.2}, {0.2, 0.1, 0.05}};
    for (const Composition composition : kCompositions) {
        expect_same(yarn, flat, "flat", composition);
        expect_same(yarn, coarse, "four subvoxels", composition);
        expect_same(yarn, region, "region", composition);
        expect_same(yarn, options_of(0.008), "batches", composition, 2);
    }
}

TEST(RasterPath, WhereNoneIsChosenBothAreTriedAndTheDrawnSumsAreTheirs) {
    const Geometry yarn = tilted_yarn();
    const VoxelizePlan plan = plan_voxelize(yarn, options_of(0.03));
    const LatticeUnits units(plan.lattice);
    const BrickGrid grid(units, {}, plan.voxel_lo, plan.voxel_hi);
    const slice::SectionLayers sections = slice::build_sections(yarn, 0);
    const opengl::Context context;
    const std::vector<slice::SliceChunk> chunks =
        slice::place_slices(context, yarn, sections, units, {});
    const std::vector<TouchedBlock> blocks =
        find_blocks(context, make_mark_program(), grid, chunks);
    SegmentResources kit(context, RasterPath::Fragment, Composition::Accumulate);
    const slice::SectionTextures textures(sections);
    BrickRasterizer rasterizer(context, kit, grid, textures, chunks,
                               {.weight_bits = 8, .memory_bytes = 1 << 26, .bricks = 1 << 20});
    const RasterBatch fragment = rasterizer.draw(blocks, 0);
    kit.choose(RasterPath::Auto);
    const RasterBatch tried = rasterizer.draw(blocks, 0);
    EXPECT_NE(kit.path(), RasterPath::Auto);
    ASSERT_EQ(tried.materials.size(), 1u);
    EXPECT_TRUE(tried.materials == fragment.materials);
}

} // namespace
} // namespace heddle::raster
