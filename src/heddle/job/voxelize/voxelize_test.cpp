#include <heddle/job/voxelize/voxelize.h>

#include <heddle/io/vdb/content_hash.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/job/generate_geometry.h>
#include <heddle/job/option_error.h>
#include <heddle/job/test_job.h>
#include <heddle/job/voxelize/voxelize_frames.h>
#include <heddle/job/voxelize/voxelize_vol.h>

#include <gtest/gtest.h>

#include <tuple>

namespace heddle::job {
namespace {

using heddle::testing::TempFolder;

VoxelizeJobOptions options_of(std::int64_t voxels) {
    VoxelizeJobOptions options;
    options.voxels = voxels;
    options.device = DeviceChoice::Cpu;
    return options;
}

/// The hash of levels in memory.
std::string hash_of(const VoxelLevels& levels, const TempFolder& folder) {
    Progress silent;
    write_vdb(levels, folder.file("memory.vdb"), silent);
    return content_hash(folder.file("memory.vdb"));
}

TEST(VoxelizeJob, MemoryAndFileHoldTheSameVoxelsByEachBackend) {
    const TempFolder folder;
    Progress silent;
    for (const Backend backend : {Backend::Sample, Backend::Raster}) {
        VoxelizeJobOptions options = options_of(40);
        options.backend = backend;
        const VoxelizeResult made = voxelize({.geometry = test::two_yarns()}, options, silent);
        const VoxelizeReport report = voxelize_to_file({.geometry = test::two_yarns()},
                                                       folder.file("a.vdb"), options, silent);
        EXPECT_EQ(content_hash(folder.file("a.vdb")), hash_of(made.levels, folder));
        EXPECT_GT(made.report.counts.voxels, 100);
        EXPECT_EQ(report.counts.voxels, made.report.counts.voxels);
        EXPECT_EQ(made.report.counts.levels, static_cast<std::int64_t>(made.levels.size()));
        EXPECT_EQ(made.report.file_bytes, 0);
        EXPECT_GT(report.file_bytes, 0);
        EXPECT_EQ(made.report.raster.has_value(), backend == Backend::Raster);
        EXPECT_EQ(made.report.plan.fields.footprints, 4) << "curves alone have footprints";
        EXPECT_GT(report.phases.size(), 2u);
    }
}

TEST(VoxelizeJob, AFinestLevelAloneHasItsCorrelation) {
    const TempFolder folder;
    Progress silent;
    VoxelizeJobOptions options = options_of(30);
    options.correlation = true;
    options.levels = 0;
    const VoxelizeReport report =
        voxelize_to_file({.geometry = test::two_yarns()}, folder.file("a.vdb"), options, silent);
    EXPECT_EQ(report.counts.levels, 1);
    EXPECT_TRUE(read_levels(folder.file("a.vdb"))[0]->info().fields.correlation);
}

TEST(VoxelizeJob, APlanPredictsAndWritesNothing) {
    Progress silent;
    const VoxelizeReport plan =
        plan_voxelize({.geometry = test::two_yarns()}, options_of(40), silent);
    EXPECT_GT(plan.plan.voxels, 0);
    EXPECT_GT(plan.predicted_file_bytes, 0);
    EXPECT_EQ(plan.counts.voxels, 0);
    VoxelizeJobOptions filled;
    filled.fill_memory = true;
    filled.memory_bytes = std::int64_t{64} << 20;
    const GeometryInput thin{.geometry = test::two_yarns(), .options = {.yarn_radius = 0.01}};
    const VoxelizeReport fits = plan_voxelize(thin, filled, silent);
    EXPECT_LE(fits.plan.peak_bytes, filled.memory_bytes);
    EXPECT_FALSE(fits.plan.spool);
    EXPECT_GT(fits.plan.voxels, 1000);
}

TEST(VoxelizeJob, NotesAreToldAndKept) {
    Geometry geometry = test::two_yarns();
    geometry.notes = {"radius estimated"};
    test::CancelAt progress(test::kNever);
    const VoxelizeReport plan = plan_voxelize({.geometry = geometry}, options_of(20), progress);
    EXPECT_EQ(plan.notes, geometry.notes);
    EXPECT_EQ(progress.notes, geometry.notes);
}

TEST(VoxelizeJob, CancelledItThrowsAndLeavesNoFile) {
    const TempFolder folder;
    test::expect_cancelled(folder, 0, [&](Progress& progress) {
        voxelize_to_file({.geometry = test::two_yarns()}, folder.file("a.vdb"), options_of(200),
                         progress);
    });
    test::expect_cancelled(folder, 0, [&](Progress& progress) {
        (void)voxelize({.geometry = test::two_yarns()}, options_of(200), progress);
    });
}

TEST(VoxelizeJob, OptionsThatDoNotGoTogetherAreRefusedInWords) {
    const auto refused = [](const VoxelizeJobOptions& options) -> std::string {
        try {
            check_voxelize_options(options);
        } catch (const OptionError& e) {
            return e.what();
        }
        return "no error";
    };
    EXPECT_EQ(refused({}), "no error");
    EXPECT_EQ(refused({.voxel_size = Vec3d{1, 1, 1}, .voxels = 3}),
              "`voxel_size` and `voxels` both set the resolution; give one of them");
    EXPECT_NE(refused({.voxels = 3, .fill_memory = true}), "no error");
    EXPECT_NE(refused({.bounds = Bounds{{1, 0, 0}, {0, 1, 1}}}), "no error");
    EXPECT_NE(refused({.samples = 3}), "no error");
    EXPECT_NE(refused({.correlation = true, .lod = LodMethod::Naive}), "no error");
    EXPECT_NE(refused({.levels = 99}), "no error");
    EXPECT_NE(refused({.memory_bytes = 0}), "no error");
    EXPECT_EQ(refused({.composition = raster::Composition::Max}),
              "`composition` needs `backend` raster");
    EXPECT_EQ(refused({.fit = FitMode::Last, .backend = Backend::Raster}),
              "`fit` last cannot be used with `backend` raster");
    EXPECT_NE(refused({.backend = Backend::Raster, .device = DeviceChoice::Cuda}), "no error");
    EXPECT_NE(refused({.device = DeviceChoice::Cpu, .device_memory_bytes = 5}), "no error");
}

TEST(VoxelizeJob, CurvesOfASurfacesMaterialAreRefused) {
    Geometry geometry = test::two_yarns();
    geometry.materials[0].kind = MaterialKind::Surface;
    Progress silent;
    heddle::testing::expect_error(
        ErrorCode::InvalidArgument, "set the material's kind to fiber",
        [&] { (void)voxelize({.geometry = geometry}, options_of(20), silent); });
}

TEST(VoxelizeJob, FramesHaveTheBitsOfTheirOwnAndStayWhereALaterOneFails) {
    const TempFolder folder;
    Progress silent;
    std::vector<AnimationFrame> frames;
    for (const std::int64_t k : {1, 2}) {
        const std::string name = folder.file(str("in_", k, ".bcc"));
        generate_to_file({.nx = k + 1, .ny = 2}, name, silent);
        frames.push_back({k, name, folder.file(str("out_", k, ".vdb"))});
    }
    test::CancelAt progress(test::kNever);
    const std::vector<VoxelizeReport> done = voxelize_frames(frames, {}, options_of(30), progress);
    ASSERT_EQ(done.size(), 2u);
    EXPECT_EQ(progress.parts, (std::vector<std::string>{"frame 1 of 2", "frame 2 of 2"}));
    const VoxelizeResult alone = voxelize({.path = frames[1].input}, options_of(30), silent);
    EXPECT_EQ(content_hash(frames[1].output), hash_of(alone.levels, folder));
    std::filesystem::remove(frames[0].output);
    (void)folder.write("in_2.bcc", "broken");
    heddle::testing::expect_error(ErrorCode::BadFile, "in_2.bcc: frame 2: ", [&] {
        (void)voxelize_frames(frames, {}, options_of(30), silent);
    });
    EXPECT_TRUE(std::filesystem::exists(frames[0].output));
    EXPECT_EQ(plan_frames({frames[0]}, {}, options_of(30), silent)[0].file_bytes, 0);
}

/// A .vol of 4^3 samples of density .5.
std::string write_vol(const TempFolder& folder) {
    using heddle::testing::bytes;
    std::string file = "VOL\3" + bytes(std::int32_t{3}, std::int32_t{4}, std::int32_t{4},
                                       std::int32_t{4}, std::int32_t{1});
    file += bytes(0.0f, 0.0f, 0.0f, 1.0f, 1.0f, 1.0f) + std::string(64, '\x7f');
    return folder.write("a.vol", file);
}

TEST(VoxelizeVol, MemoryAndFileHoldTheSameVoxels) {
    const TempFolder folder;
    Progress silent;
    const std::string path = write_vol(folder);
    EXPECT_TRUE(is_vol_file(path));
    EXPECT_EQ(plan_vol(path, {}, silent).layout.samples(), (Vec3i{4, 4, 4}));
    const VolResult made = voxelize_vol(path, {}, silent);
    EXPECT_TRUE(made.levels[0]->info().fields.occupancy);
    const VolResult plain = voxelize_vol(path, {.occupancy = false}, silent);
    EXPECT_FALSE(plain.levels[0]->info().fields.occupancy);
    const VolReport report = voxelize_vol_to_file(path, folder.file("b.vdb"), {}, silent);
    EXPECT_EQ(made.report.counts.voxels, 64);
    EXPECT_EQ(report.counts.levels, made.report.counts.levels);
    EXPECT_EQ(content_hash(folder.file("b.vdb")), hash_of(made.levels, folder));
    EXPECT_THROW((void)voxelize_vol(path, {.density_scale = -1.0}, silent), OptionError);
    const std::size_t entries = folder.count_entries();
    test::expect_cancelled(folder, entries, [&](Progress& progress) {
        voxelize_vol_to_file(path, folder.file("c.vdb"), {}, progress);
    });
}

} // namespace
} // namespace heddle::job
