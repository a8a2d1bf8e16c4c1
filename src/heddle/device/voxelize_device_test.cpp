#include <heddle/device/voxelize_device.h>

#include <heddle/device/device_run.h>
#include <heddle/device/level/build_batch.h>
#include <heddle/executor/host_executor.h>
#include <heddle/voxelize/test_swatch.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

using namespace heddle::test;

VoxelizeOptions options_of(std::int64_t voxels) {
    VoxelizeOptions options;
    options.voxels = voxels;
    options.seed = 5;
    options.spool_dir = testing::TempDir();
    return options;
}

/// Expects that the levels by the host executor equal those of the CPU.
void expect_parity(const Geometry& geometry,
                   const VoxelizeOptions& options,
                   DeviceOptions device = {},
                   std::int64_t least_voxels = 100) {
    const VoxelizePlan plan = plan_voxelize(geometry, options);
    Progress silent;
    LevelBuilder cpu_levels({});
    auto cpu = voxelize(geometry, options, plan, silent, &cpu_levels);
    const VoxelLevels expected = cpu_levels.finish(std::move(cpu));
    LevelBuilder levels({});
    auto level0 = voxelize_on_host_executor(geometry, options, plan, device, silent, &levels);
    const VoxelLevels found = levels.finish(std::move(level0));
    ASSERT_EQ(found.size(), expected.size());
    ASSERT_GE(expected[0]->info().voxel_count, least_voxels);
    for (std::size_t l = 0; l < found.size(); ++l) {
        EXPECT_EQ(found[l]->info().voxel_count, expected[l]->info().voxel_count);
        ASSERT_EQ(found[l]->block_count(), expected[l]->block_count());
        VoxelBlock a, b;
        for (std::size_t i = 0; i < found[l]->block_count(); ++i) {
            expect_same_block(found[l]->block(i, a), expected[l]->block(i, b));
        }
    }
}

TEST(DeviceVoxelizer, YarnAndHairAreTheCpus) {
    for (const int subvoxels : {1, 2, 4, 8}) {
        VoxelizeOptions options = options_of(100);
        options.subvoxels = subvoxels;
        options.keep_sums = subvoxels == 4;
        options.footprints = subvoxels == 8 ? 4 : 0;
        expect_parity(hairy_swatch(), options);
    }
}

Geometry generated(GenerateKind kind, std::int64_t nx, std::int64_t ny) {
    GenerateOptions options;
    options.kind = kind;
    options.nx = nx;
    options.ny = ny;
    return generate(options);
}

TEST(DeviceVoxelizer, SurfacesAreTheCpus) {
    expect_parity(generated(GenerateKind::Brushed, 48, 48), options_of(80));
    expect_parity(generated(GenerateKind::Grass, 20, 5), options_of(80));
}

TEST(DeviceVoxelizer, SlabsOfDisplacedAndClippedSurfacesAreTheCpus) {
    Geometry plate = generated(GenerateKind::Brushed, 8, 8);
    Texture waves;
    waves.width = 8;
    waves.height = 1;
    waves.channels = 4;
    for (const int h : {0, 90, 200, 255, 200, 90, 30, 10}) {
        waves.texels.insert(waves.texels.end(), 4, static_cast<std::uint8_t>(h));
    }
    plate.textures.push_back(waves);
    Material& material = plate.materials[plate.meshes[0].material];
    material.height_map = static_cast<std::int32_t>(plate.textures.size()) - 1;
    const Bounds box = plan_voxelize(plate, options_of(60)).bounds;
    material.height_scale = static_cast<float>(0.1 * box.size().x);
    VoxelizeOptions options = options_of(60);
    options.keep_sums = true;
    expect_parity(plate, options);
    options.voxels = 0;
    const double h = box.size().x / 70.0;
    options.voxel_size = {h, 1.2 * h, 0.8 * h};
    Bounds region;
    region.grow(box.lo + box.size() * 0.2);
    region.grow(box.lo + box.size() * 0.7 + Vec3d{0.0, 0.0, box.size().x});
    options.bounds = region;
    expect_parity(plate, options);
}

TEST(DeviceVoxelizer, ManyMaterialsShareLobesAsOnTheCpu) {
    Geometry g = swatch();
    const Geometry grass = generated(GenerateKind::Grass, 20, 5);
    g.textures = grass.textures;
    for (const Mesh& mesh : grass.meshes) {
        g.meshes.push_back(mesh);
        g.meshes.back().material = static_cast<std::uint32_t>(g.materials.size());
        g.materials.push_back(grass.materials[mesh.material]);
    }
    for (const int lobes : {1, 2, 3}) {
        VoxelizeOptions options = options_of(60);
        options.max_lobes = lobes;
        expect_parity(g, options);
    }
}

TEST(DeviceVoxelizer, MoreMaterialsThanMergeAtOnceAreTheCpus) {
    Geometry g;
    g.name = "bundle";
    for (std::uint32_t m = 0; m < 90; ++m) {
        g.materials.emplace_back().kind = MaterialKind::Fiber;
        CurveSet set;
        set.basis = Basis::Linear;
        set.material = m;
        set.default_radius = 0.02f;
        for (std::uint32_t k = 0; k < 2; ++k) {
            const auto u = [&](std::uint64_t axis) { return to_unit_float(hash64(m, k, axis)); };
            set.points.push_back({u(0), u(1), u(2)});
        }
        set.first = {0, 2};
        g.curves.push_back(set);
    }
    VoxelizeOptions options = options_of(0);
    options.voxel_size = {0.5, 0.5, 0.5};
    expect_parity(g, options, {}, 8);
    options.voxel_size = {0.1, 0.1, 0.1};
    expect_parity(g, options);
}

TEST(DeviceVoxelizer, ThickFibersAreTheCpus) {
    Geometry g = swatch();
    g.curves[0].yarn = -1;
    expect_parity(g, options_of(120));
}

TEST(DeviceVoxelizer, BatchesStreamsAndTheSpoolDoNotShow) {
    for (const std::int64_t batches : {8, 64}) {
        DeviceOptions device;
        device.batches = batches;
        device.streams = batches == 8 ? 1 : 3;
        expect_parity(swatch(), options_of(150), device);
    }
}

TEST(DeviceVoxelizer, FlatVoxelsAndARegionAreTheCpus) {
    VoxelizeOptions options = options_of(0);
    const Bounds box = plan_voxelize(hairy_swatch(), options_of(120)).bounds;
    const double h = box.size().x / 100.0;
    options.voxel_size = {h, 1.3 * h, 0.6 * h};
    expect_parity(hairy_swatch(), options);
    Bounds region;
    region.grow(box.lo + box.size() * 0.3);
    region.grow(box.lo + box.size() * 0.75);
    options.bounds = region;
    expect_parity(hairy_swatch(), options);
}

/// Calls run(), expecting an Error.
template <typename Run>
Error error_of_run(const Run& run) {
    try {
        static_cast<void>(run());
    } catch (const Error& e) {
        return e;
    }
    return Error(ErrorCode::Internal, "no error");
}

Error error_of(const VoxelizeOptions& options, const DeviceOptions& device) {
    const VoxelizePlan plan = plan_voxelize(swatch(), options_of(60));
    Progress silent;
    return error_of_run([&] {
        return voxelize_on_host_executor(swatch(), options, plan, device, silent, nullptr);
    });
}

/// An executor whose device is gone after some launches.
class VanishingExecutor : public executor::HostExecutor {
public:
    VanishingExecutor(executor::Budget& budget, int launches)
        : HostExecutor(budget), launches_left_(launches) {}

    template <typename Op>
    void for_each(std::size_t n, const Op& op) {
        launch();
        HostExecutor::for_each(n, op);
    }
    template <typename In, typename Out>
    void offsets(const In* count, Out* first, std::size_t n) {
        launch();
        HostExecutor::offsets(count, first, n);
    }

private:
    void launch() {
        if (launches_left_-- > 0) return;
        throw Error(ErrorCode::Device, str(stage(), ": the device is gone"), "use --device cpu");
    }
    int launches_left_;
};

TEST(DeviceVoxelizer, LittleMemoryTakesSmallBatchesAndTooLittleIsOneLine) {
    DeviceOptions device;
    device.memory_bytes = 40 << 20;
    expect_parity(swatch(), options_of(150), device);
    device.memory_bytes = 4 << 20; // less than the sums of a block
    const Error e = error_of(options_of(60), device);
    EXPECT_EQ(e.code(), ErrorCode::OutOfMemory);
    EXPECT_NE(std::string(e.what()).find("raise --device-memory"), std::string::npos) << e.what();
}

TEST(DeviceVoxelizer, ADeviceThatVanishesAtAnyLaunchIsOneLine) {
    const VoxelizeOptions options = options_of(60);
    const VoxelizePlan plan = plan_voxelize(swatch(), options);
    const auto prepared = take_prepared(plan, swatch(), options.seed);
    const VoxelizeContext context(*prepared, options);
    DeviceOptions device;
    device.memory_bytes = std::int64_t{1} << 30;
    for (const int launches : {0, 1, 3, 9, 15}) {
        DeviceRun<VanishingExecutor> run(context, plan, device, [&](executor::Budget& budget) {
            return std::make_unique<VanishingExecutor>(budget, launches);
        });
        Progress silent;
        const Error e = error_of_run([&] { return run.run(silent, nullptr); });
        EXPECT_EQ(e.code(), ErrorCode::Device) << launches;
        EXPECT_NE(std::string(e.what()).find("the device is gone"), std::string::npos) << e.what();
    }
}

TEST(DeviceVoxelizer, WhatItDoesNotDoIsRefused) {
    VoxelizeOptions options = options_of(60);
    options.coverage = CoverageMode::Mask;
    EXPECT_EQ(error_of(options, {}).code(), ErrorCode::Unsupported);
    options.coverage = CoverageMode::Columns;
    options.fit = FitMode::Last;
    EXPECT_EQ(error_of(options, {}).code(), ErrorCode::Unsupported);
    DeviceOptions device;
    device.streams = 0;
    EXPECT_EQ(error_of(options_of(60), device).code(), ErrorCode::InvalidArgument);
}

TEST(DeviceVoxelizer, CancelStops) {
    const VoxelizePlan plan = plan_voxelize(swatch(), options_of(60));
    Progress progress;
    progress.cancel();
    EXPECT_THROW(static_cast<void>(voxelize_on_host_executor(swatch(), options_of(60), plan, {},
                                                             progress, nullptr)),
                 Error);
}

} // namespace
} // namespace heddle
