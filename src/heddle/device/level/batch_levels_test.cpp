#include <heddle/device/level/batch_levels.h>

#include <heddle/base/parallel.h>
#include <heddle/device/level/block_cell.h>
#include <heddle/executor/host_executor.h>
#include <heddle/lod/build_levels.h>
#include <heddle/lod/level_subset.h>
#include <heddle/voxel/leaf_voxels.h>
#include <heddle/voxelize/test_swatch.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

namespace heddle {
namespace {

using namespace heddle::test;

/// Blocks of level 0 with columns and sums, none empty.
struct Finest {
    std::unique_ptr<VoxelLevel> source;
    std::vector<VoxelBlock> blocks;
    std::vector<Vec3i> index;
};

Finest voxelized(const Geometry& geometry, VoxelizeOptions options) {
    options.keep_sums = true;
    options.seed = 3;
    options.spool_dir = testing::TempDir();
    Progress silent;
    Finest out;
    out.source = voxelize(geometry, options, plan_voxelize(geometry, options, silent), silent);
    VoxelBlock scratch;
    for (std::size_t b = 0; b < out.source->block_count(); ++b) {
        const VoxelBlock& block = out.source->block(b, scratch);
        if (block.leaves.empty()) continue;
        const Vec3i at = block.leaves[0].origin;
        out.index.push_back({at.x >> 5, at.y >> 5, at.z >> 5});
        out.blocks.push_back(block);
    }
    return out;
}

/// One voxel of a block, and the positions of its data.
struct KeyedVoxel {
    std::uint64_t key;
    std::size_t voxel;
    std::size_t lobe;
};

std::vector<KeyedVoxel> places_of(const VoxelBlock& block, Vec3i index) {
    std::vector<KeyedVoxel> out;
    for_each_voxel(block, [&](const BlockVoxel& v) {
        out.push_back({z_order_from_index(v.at - index * kBlockVoxels), v.voxel, v.lobe});
    });
    std::sort(out.begin(), out.end(),
              [](const KeyedVoxel& a, const KeyedVoxel& b) { return a.key < b.key; });
    return out;
}

/// Level 0 of blocks [begin, end), as from a voxelizer.
LevelArrays
arrays_of(executor::HostExecutor& exec, const Finest& finest, std::size_t begin, std::size_t end) {
    const int n = finest.source->info().lattice.subvoxels;
    std::vector<std::uint64_t> key, columns, occupancy;
    std::vector<std::uint32_t> hits, order;
    std::vector<std::uint32_t> first_lobe{0};
    std::vector<DirectionSums> lobes;
    std::vector<MapSums> maps;
    std::vector<OpenSlab> slabs;
    for (std::size_t b = begin; b < end; ++b) {
        const VoxelBlock& block = finest.blocks[b];
        for (const KeyedVoxel& at : places_of(block, finest.index[b])) {
            key.push_back(static_cast<std::uint64_t>(b - begin) << 15 | at.key);
            hits.push_back((block.coverage[at.voxel].occupancy * unsigned(n * n * n) + 32767) /
                           65535);
            order.push_back(block.merge_order.empty() ? 0 : block.merge_order[at.voxel]);
            if (!block.occupancy.empty()) occupancy.push_back(block.occupancy[at.voxel]);
            const auto& words = block.columns[at.voxel];
            columns.insert(columns.end(), words.begin(), words.end());
            for (std::size_t l = at.lobe; l < at.lobe + block.lobe_count[at.voxel]; ++l) {
                DirectionSums& sums = lobes.emplace_back();
                std::copy_n(block.moments[l].moment.begin(), 6, sums.moment);
                sums.weight = block.moments[l].weight;
                sums.material = block.lobes[l].material;
                sums.normals =
                    finest.source->info().materials[sums.material].kind == MaterialKind::Surface;
                if (!block.map_sums.empty()) maps.push_back(block.map_sums[l]);
            }
            first_lobe.push_back(static_cast<std::uint32_t>(lobes.size()));
            if (block.slabs.empty()) continue;
            const Lobe& first = block.lobes[at.lobe];
            const Vec3d edges = finest.source->info().lattice.voxel_size;
            const bool surface =
                finest.source->info().materials[first.material].kind == MaterialKind::Surface;
            slabs.push_back(surface ? OpenSlab(block.slabs[at.voxel], edges) : OpenSlab());
        }
    }
    LevelArrays out;
    out.voxel_count = key.size();
    out.lobe_count = lobes.size();
    out.key = exec.make_from(std::span<const std::uint64_t>(key));
    out.hits = exec.make_from(std::span<const std::uint32_t>(hits));
    out.first_lobe = exec.make_from(std::span<const std::uint32_t>(first_lobe));
    out.order = exec.make_from(std::span<const std::uint32_t>(order));
    out.columns = exec.make_from(std::span<const std::uint64_t>(columns));
    out.occupancy = exec.make_from(std::span<const std::uint64_t>(occupancy));
    out.lobes = exec.make_from(std::span<const DirectionSums>(lobes));
    out.maps = exec.make_from(std::span<const MapSums>(maps));
    out.slabs = exec.make_from(std::span<const OpenSlab>(slabs));
    return out;
}

BatchOptions settings_of(const Finest& finest, const LevelBuilder& builder) {
    const VoxelLevelInfo& info = finest.source->info();
    const LevelOptions& above = *builder.options_of_built();
    BatchOptions out;
    out.level0.subvoxels = out.above.subvoxels = info.lattice.subvoxels;
    out.level0.max_lobes = info.max_lobes;
    out.level0.fields = info.fields;
    out.above.max_lobes = above.merge.max_lobes;
    out.above.fields = above.fields;
    out.above.normals = above.normals;
    out.above.voxel_size = above.lattice.voxel_size;
    out.levels = builder.built_levels();
    out.top = builder.wants_top();
    return out;
}

VoxelLevels built_by_visits(const Finest& finest, const LodOptions& lod) {
    LevelBuilder builder(lod);
    builder.begin(finest.source->info(), finest.index, {});
    for (std::size_t b = 0; b < finest.blocks.size(); ++b) builder.visit(b, finest.blocks[b]);
    return builder.finish(std::make_unique<LevelSubset>(*finest.source));
}

/// Builds the levels batch by batch. Expects that level 0 is returned unchanged and that no batch
/// needs more memory than predicted.
VoxelLevels built_by_batches(const Finest& finest, const LodOptions& lod, std::size_t batches) {
    LevelBuilder builder(lod);
    builder.begin(finest.source->info(), finest.index, {});
    const BatchOptions settings = settings_of(finest, builder);
    BatchLevels built;
    const std::size_t count = finest.blocks.size();
    for (std::size_t k = 0; k < batches; ++k) {
        const std::size_t begin = count * k / batches;
        const std::size_t end = count * (k + 1) / batches;
        executor::Budget budget(std::int64_t{1} << 32);
        executor::HostExecutor exec(budget);
        LevelArrays level0 = arrays_of(exec, finest, begin, end);
        const std::int64_t predicted = predict_level_bytes(
            static_cast<std::int64_t>(end - begin), static_cast<std::int64_t>(level0.voxel_count),
            static_cast<std::int64_t>(level0.lobe_count), settings);
        build_batch_levels(exec, std::move(level0), end - begin, settings, built);
        EXPECT_EQ(budget.used(), 0);
        EXPECT_LE(budget.peak(), predicted);
        for (std::size_t b = begin; b < end; ++b) {
            VoxelBlock block;
            BuiltBlock levels;
            built.cut(b - begin, finest.index[b], block, levels);
            expect_same_block(block, finest.blocks[b]);
            builder.accept(b, block, levels);
        }
    }
    return builder.finish(std::make_unique<LevelSubset>(*finest.source));
}

void expect_parity(const Geometry& geometry,
                   const VoxelizeOptions& options,
                   std::size_t batches,
                   const LodOptions& lod = {}) {
    const Finest finest = voxelized(geometry, options);
    ASSERT_GT(finest.source->info().voxel_count, 500);
    const VoxelLevels expected = built_by_visits(finest, lod);
    const VoxelLevels found = built_by_batches(finest, lod, batches);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t l = 1; l < found.size(); ++l) {
        EXPECT_EQ(found[l]->info().voxel_count, expected[l]->info().voxel_count);
        EXPECT_EQ(found[l]->info().lobe_count, expected[l]->info().lobe_count);
        ASSERT_EQ(found[l]->block_count(), expected[l]->block_count());
        VoxelBlock a, b;
        for (std::size_t i = 0; i < found[l]->block_count(); ++i) {
            expect_same_block(found[l]->block(i, a), expected[l]->block(i, b));
        }
    }
}

Geometry generated(GenerateKind kind, std::int64_t nx, std::int64_t ny) {
    GenerateOptions options;
    options.kind = kind;
    options.nx = nx;
    options.ny = ny;
    return generate(options);
}

VoxelizeOptions voxels(std::int64_t n) {
    VoxelizeOptions options;
    options.voxels = n;
    return options;
}

TEST(BatchLevels, OfYarnAndHairAreTheLevelBuilders) {
    VoxelizeOptions options = voxels(150);
    options.footprints = 4;
    expect_parity(hairy_swatch(), options, 1);
    expect_parity(swatch(), options, 8);
}

TEST(BatchLevels, WithoutOccupancyAreTheLevelBuilders) {
    VoxelizeOptions options = voxels(100);
    options.occupancy = false;
    expect_parity(swatch(), options, 3);
}

TEST(BatchLevels, OfManyBatchesAreTheLevelBuilders) {
    expect_parity(generated(GenerateKind::Hair, 500, 12), voxels(200), 64);
    expect_parity(generated(GenerateKind::Plain, 4, 4), voxels(100), 8);
}

TEST(BatchLevels, OfMapsAndTangentsAreTheLevelBuilders) {
    VoxelizeOptions options = voxels(130);
    options.footprints = 8;
    const Geometry plate = generated(GenerateKind::Brushed, 64, 64);
    const Finest finest = voxelized(plate, options);
    ASSERT_TRUE(finest.source->info().fields.maps() && finest.source->info().fields.tangents);
    expect_parity(plate, options, 3);
}

TEST(BatchLevels, OfMeshesAreTheLevelBuilders) {
    expect_parity(generated(GenerateKind::Grass, 40, 6), voxels(100), 8);
}

TEST(BatchLevels, OfFlatVoxelsInARegionAreTheLevelBuilders) {
    VoxelizeOptions options = voxels(150);
    const VoxelizePlan plan = plan_voxelize(swatch(), options);
    const double h = plan.lattice.voxel_size.x;
    options.voxels = 0;
    options.voxel_size = {h, h * 1.25, h * 0.5};
    Bounds part;
    part.grow(plan.bounds.lo + plan.bounds.size() * 0.3);
    part.grow(plan.bounds.lo + plan.bounds.size() * 0.8);
    options.bounds = part;
    expect_parity(swatch(), options, 8);
}

TEST(BatchLevels, OfFewSubvoxelsAndOtherLobesAreTheLevelBuilders) {
    for (const int subvoxels : {1, 2, 4}) {
        VoxelizeOptions options = voxels(100);
        options.subvoxels = subvoxels;
        options.footprints = 8;
        expect_parity(swatch(), options, 2, {.max_lobes = subvoxels});
    }
    expect_parity(swatch(), voxels(80), 1, {.max_levels = 2, .max_lobes = 8});
}

TEST(BatchLevels, ThreadsDoNotShow) {
    const Finest finest = voxelized(swatch(), voxels(100));
    set_thread_count(1);
    const VoxelLevels one = built_by_batches(finest, {}, 2);
    set_thread_count(4);
    const VoxelLevels four = built_by_batches(finest, {}, 2);
    set_thread_count(0);
    ASSERT_EQ(one.size(), four.size());
    VoxelBlock a, b;
    for (std::size_t l = 1; l < one.size(); ++l) {
        for (std::size_t i = 0; i < one[l]->block_count(); ++i) {
            expect_same_block(one[l]->block(i, a), four[l]->block(i, b));
        }
    }
}

TEST(BatchLevels, TooLittleMemoryIsAnErrorOfOneLine) {
    const Finest finest = voxelized(swatch(), voxels(60));
    LevelBuilder builder({});
    builder.begin(finest.source->info(), finest.index, {});
    const BatchOptions settings = settings_of(finest, builder);
    const auto build = [&](executor::Budget& budget) {
        executor::HostExecutor exec(budget);
        BatchLevels built;
        const std::size_t blocks = finest.blocks.size();
        build_batch_levels(exec, arrays_of(exec, finest, 0, blocks), blocks, settings, built);
    };
    executor::Budget enough(std::int64_t{1} << 32);
    build(enough);
    executor::Budget all(enough.peak());
    build(all);
    executor::Budget less(enough.peak() - 1);
    try {
        build(less);
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::OutOfMemory);
        const std::string text = e.what();
        EXPECT_TRUE(text.starts_with("levels: ") || text.starts_with("store: ")) << text;
        EXPECT_TRUE(text.ends_with("raise --device-memory")) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos);
    }
    EXPECT_EQ(less.used(), 0);
}

TEST(LevelBuilder, TakesBuiltLevelsOnlyWhereTheyWouldBeItsOwn) {
    const Finest finest = voxelized(swatch(), voxels(60));
    const auto takes = [&](LodOptions lod, bool correlation, bool with_columns) {
        LevelBuilder builder(lod, with_columns);
        VoxelLevelInfo info = finest.source->info();
        info.fields.correlation = correlation;
        builder.begin(info, finest.index, {});
        return builder.options_of_built() != nullptr;
    };
    EXPECT_TRUE(takes({}, false, true));
    EXPECT_FALSE(takes({}, true, true));
    EXPECT_FALSE(takes({}, false, false));
    EXPECT_FALSE(takes({.method = LodMethod::Naive}, false, true));
    EXPECT_FALSE(takes({.method = LodMethod::Wasserstein}, false, true));
}

} // namespace
} // namespace heddle
