// Each command writes what the function of the room job writes that it calls: the same options in
// words and in a struct, first the defaults and then others.
#include <heddle/io/exr/exr.h>
#include <heddle/io/vdb/content_hash.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/job/edit_materials.h>
#include <heddle/job/generate_geometry.h>
#include <heddle/job/level/measure_levels.h>
#include <heddle/job/level/rebuild_levels.h>
#include <heddle/job/render/export_volume.h>
#include <heddle/job/render/preview_volume.h>
#include <heddle/job/render/render_scene.h>
#include <heddle/job/slice_yarn.h>
#include <heddle/job/test_job.h>
#include <heddle/job/voxelize/voxelize.h>
#include <heddle/job/voxelize/voxelize_frames.h>
#include <heddle/job/voxelize/voxelize_vol.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <map>

namespace heddle::job {
namespace {

using heddle::testing::slurp;
using heddle::testing::TempFolder;
using Json = nlohmann::json;

/// The properties of materials, as text.
std::string text_of(const std::vector<Material>& materials) {
    std::string out;
    for (const Material& m : materials) {
        out += str(m.name, " ", static_cast<int>(m.kind), " ", m.albedo.x, " ", m.albedo.y, " ",
                   m.albedo.z, " ", m.roughness, " ", m.metalness, " ", m.anisotropy, " ",
                   m.anisotropy_rotation, " ", m.alpha, " ", m.fiber_radius, "\n");
    }
    return out;
}

/// A folder with a knit and a mesh of grass, in which commands run.
class CommandAndJob : public ::testing::Test {
protected:
    void SetUp() override {
        generate_to_file({.nx = 4, .ny = 4}, file("knit.bcc"), silent_);
        generate_to_file({.kind = GenerateKind::Grass, .nx = 8, .ny = 4}, file("grass.glb"),
                         silent_);
    }
    [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }

    /// Runs the program in the folder. Mesa's threads may end while LeakSanitizer inspects them, so
    /// leaks are not searched for in it.
    /// @return  what it prints
    std::string run(const std::string& words) const {
        const std::string line =
            str("cd '", folder_.path(), "' && ASAN_OPTIONS=\"$ASAN_OPTIONS:detect_leaks=0\" '",
                HEDDLE_PROGRAM, "' ", words, " >printed.txt 2>said.txt");
        EXPECT_EQ(std::system(line.c_str()), 0) << words << ": " << slurp(file("said.txt"));
        return slurp(file("printed.txt"));
    }
    /// The hash of levels in memory, as that of the file that they become.
    std::string hash_of(const VoxelLevels& levels) {
        write_vdb(levels, file("memory.vdb"), silent_);
        return content_hash(file("memory.vdb"));
    }
    /// Expects that a command wrote the voxels and the materials of these levels.
    void expect_levels(const std::string& name, const VoxelLevels& levels) {
        EXPECT_EQ(content_hash(file(name)), hash_of(levels)) << name;
        const std::vector<VoxelLevelInfo> written = read_infos(file(name));
        EXPECT_EQ(text_of(written[0].materials), text_of(levels[0]->info().materials)) << name;
        EXPECT_EQ(written.size(), levels.size()) << name;
        EXPECT_GT(written[0].voxel_count, 0) << name;
    }
    /// Makes knit.vdb, with levels and masks.
    void voxelize_knit(std::int64_t voxels = 40) {
        VoxelizeJobOptions options;
        options.voxels = voxels;
        options.keep_masks = true;
        voxelize_to_file({.path = file("knit.bcc"), .options = {.yarn = "cotton"}},
                         file("knit.vdb"), options, silent_);
    }

    TempFolder folder_;
    Progress silent_;
};

TEST_F(CommandAndJob, VoxelizeMakesTheVoxelsOfTheJob) {
    VoxelizeJobOptions plain;
    plain.voxels = 40;
    GeometryInput knit{.path = file("knit.bcc"), .options = {.yarn = "cotton"}};
    run("voxelize knit.bcc --yarn cotton --voxels 40 -o plain.vdb");
    expect_levels("plain.vdb", voxelize(knit, plain, silent_).levels);
    run("voxelize grass.glb --voxels 40 -o grass.vdb");
    expect_levels("grass.vdb", voxelize({.path = file("grass.glb")}, plain, silent_).levels);

    VoxelizeJobOptions chosen;
    chosen.voxel_size = Vec3d{0.1, 0.1, 0.2};
    chosen.bounds = Bounds{{-1, -1, -1}, {2, 2, 2}};
    chosen.lobes = 2;
    chosen.subvoxels = 4;
    chosen.coverage = CoverageMode::Mask;
    chosen.samples = 5;
    chosen.fit = FitMode::Last;
    chosen.footprints = 8;
    chosen.occupancy = false;
    chosen.correlation = true;
    chosen.keep_masks = true;
    chosen.lod = LodMethod::Random;
    chosen.levels = 2;
    chosen.seed = 7;
    chosen.memory_bytes = std::int64_t{1} << 30;
    knit.options = {.yarn = "silk", .yarn_radius = 0.3, .fibers = 12, .fiber_radius = 0.03};
    run("voxelize knit.bcc --yarn silk --yarn-radius 0.3 --fibers 12 --fiber-radius 0.03 "
        "--voxel-size 0.1,0.1,0.2 --bounds -1,-1,-1,2,2,2 --lobes 2 --subvoxels 4 "
        "--coverage mask --samples 5 --fit last --footprints 8 --occupancy 0 --correlation "
        "--keep-masks --lod random --levels 2 --seed 7 --memory 1G -o chosen.vdb");
    expect_levels("chosen.vdb", voxelize(knit, chosen, silent_).levels);
}

TEST_F(CommandAndJob, VoxelizeByOpenGLMakesTheVoxelsOfTheJob) {
    VoxelizeJobOptions options;
    options.voxels = 30;
    options.backend = Backend::Raster;
    options.composition = raster::Composition::Max;
    run("voxelize knit.bcc --yarn cotton --voxels 30 --backend raster --composition max "
        "-o raster.vdb");
    expect_levels("raster.vdb", voxelize({.path = file("knit.bcc"), .options = {.yarn = "cotton"}},
                                         options, silent_)
                                    .levels);
}

TEST_F(CommandAndJob, VoxelizeOfFramesMakesTheFilesOfTheJob) {
    std::vector<AnimationFrame> frames;
    for (const std::int64_t k : {1, 3}) {
        const std::string input = file(str("in_", k, ".bcc"));
        generate_to_file({.nx = k + 1, .ny = 2}, input, silent_);
        frames.push_back({k, input, file(str("job_", k, ".vdb"))});
    }
    VoxelizeJobOptions options;
    options.voxels = 30;
    voxelize_frames(frames, {}, options, silent_);
    run("voxelize in_%01d.bcc --frames 1-3:2 --voxels 30 -o out_%01d.vdb");
    for (const int k : {1, 3}) {
        EXPECT_EQ(content_hash(file(str("out_", k, ".vdb"))),
                  content_hash(file(str("job_", k, ".vdb"))));
    }
}

TEST_F(CommandAndJob, VoxelizeOfAVolumeMakesTheVoxelsOfTheJob) {
    voxelize_knit();
    export_volume(file("knit.vdb"), file("flakes"), {.to = ExportFormat::Mitsuba06}, silent_);
    const std::string path = file("flakes/volume.vol");
    run("voxelize flakes/volume.vol -o plain.vdb");
    expect_levels("plain.vdb", voxelize_vol(path, {}, silent_).levels);
    run("voxelize flakes/volume.vol --density-scale 30 --albedo 0.2,0.5,0.7 --lobes 1 "
        "--orientation none --occupancy 0 --lod single --levels 1 --seed 3 -o chosen.vdb");
    VolJobOptions chosen;
    chosen.orientation = "none";
    chosen.density_scale = 30.0;
    chosen.albedo = {0.2f, 0.5f, 0.7f};
    chosen.lobes = 1;
    chosen.occupancy = false;
    chosen.lod = LodMethod::Single;
    chosen.levels = 1;
    chosen.seed = 3;
    expect_levels("chosen.vdb", voxelize_vol(path, chosen, silent_).levels);
}

TEST_F(CommandAndJob, LodRebuildsTheLevelsOfTheJob) {
    voxelize_knit();
    run("lod knit.vdb -o plain.vdb");
    expect_levels("plain.vdb", rebuild_levels(read_levels(file("knit.vdb")), {}, silent_).levels);
    run("lod knit.vdb --levels 2 --lobes 1 --exact -o chosen.vdb");
    const RebuildLevelsOptions chosen{.levels = 2, .lobes = 1, .exact = true};
    expect_levels("chosen.vdb",
                  rebuild_levels(read_levels(file("knit.vdb")), chosen, silent_).levels);
    run("lod knit.vdb --lod random --seed 5 -o drawn.vdb");
    const RebuildLevelsOptions drawn{.lod = LodMethod::Random, .seed = 5};
    expect_levels("drawn.vdb",
                  rebuild_levels(read_levels(file("knit.vdb")), drawn, silent_).levels);
}

/// The numbers of a report that do not depend on the time, by method and level.
std::map<std::string, std::vector<double>> numbers_of(const LevelTable& table) {
    std::map<std::string, std::vector<double>> out;
    for (const MethodRow& m : table.methods) {
        for (const LevelErrors& e : m.errors.levels) {
            out[str(m.errors.name, e.level)] = {static_cast<double>(e.voxels),
                                                static_cast<double>(e.lobes),
                                                static_cast<double>(e.parents),
                                                static_cast<double>(m.bytes_at(e.level)),
                                                e.sigma,
                                                e.cells,
                                                e.moment,
                                                e.moment_worst,
                                                e.coverage.value_or(-1.0)};
        }
    }
    return out;
}
std::map<std::string, std::vector<double>> numbers_of(const Json& printed) {
    std::map<std::string, std::vector<double>> out;
    for (const Json& m : printed.at("methods")) {
        for (const Json& e : m.at("levels")) {
            std::vector<double>& row =
                out[str(m.at("name").get<std::string>(), e.at("level").get<int>())];
            for (const char* key : {"voxels", "lobes", "parents", "bytes", "sigma_error",
                                    "density_l1", "moment_median", "moment_largest"}) {
                row.push_back(e.at(key).get<double>());
            }
            const Json& coverage = e.at("coverage_mean");
            row.push_back(coverage.is_null() ? -1.0 : coverage.get<double>());
        }
    }
    return out;
}

TEST_F(CommandAndJob, LodReportPrintsTheErrorsOfTheJob) {
    voxelize_knit(14);
    const Json plain = Json::parse(run("lod-report knit.vdb --json"));
    EXPECT_EQ(numbers_of(plain), numbers_of(measure_levels(file("knit.vdb"), {}, silent_)));
    const Json printed = Json::parse(
        run("lod-report knit.vdb --methods single,random --parents 9 --part 200 --lobes 2 "
            "--seed 4 --plot command.svg --json"));
    const MeasureLevelsOptions chosen{.methods = {LodMethod::Single, LodMethod::Random},
                                      .parents = 9,
                                      .part = 200,
                                      .lobes = 2,
                                      .seed = 4,
                                      .plot = file("job.svg")};
    const LevelTable table = measure_levels(file("knit.vdb"), chosen, silent_);
    EXPECT_EQ(numbers_of(printed), numbers_of(table));
    EXPECT_EQ(slurp(file("command.svg")), slurp(file("job.svg")));
}

TEST_F(CommandAndJob, RenderMakesThePictureOfTheJob) {
    voxelize_knit();
    run("render knit.vdb --size 24x16 --samples 2 -o plain.exr");
    const RenderOptions plain{.samples = 2, .size = PictureSize{24, 16}};
    render_scene_to_file(file("knit.vdb"), file("job.exr"), plain, silent_);
    EXPECT_EQ(read_exr_rgb(file("plain.exr")).values, read_exr_rgb(file("job.exr")).values);

    run("render knit.vdb --size 24x16 --samples 3 --level-offset 0.5 --transport product "
        "--seed 7 --exposure 1 -o chosen.png");
    RenderOptions chosen{.level_offset = 0.5,
                         .transport = "product",
                         .samples = 3,
                         .size = PictureSize{24, 16},
                         .seed = 7,
                         .exposure = 1.0};
    render_scene_to_file(file("knit.vdb"), file("job.png"), chosen, silent_);
    EXPECT_EQ(slurp(file("chosen.png")), slurp(file("job.png")));
    run("render knit.vdb --size 24x16 --samples 1 --level 1 -o level.png");
    render_scene_to_file(file("knit.vdb"), file("job.png"),
                         {.level = 1, .samples = 1, .size = PictureSize{24, 16}}, silent_);
    EXPECT_EQ(slurp(file("level.png")), slurp(file("job.png")));
}

/// The bytes of each file of a folder.
std::map<std::string, std::string> files_of(const std::string& folder) {
    std::map<std::string, std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        out[entry.path().filename().string()] = slurp(entry.path().string());
    }
    return out;
}

TEST_F(CommandAndJob, ExportWritesTheFilesOfTheJob) {
    voxelize_knit();
    const std::vector<std::pair<std::string, ExportOptions>> cases{
        {"", {}},
        {"--level 1 --pad 1.5", {.level = 1, .pad = 1.5}},
        {"--to mitsuba06", {.to = ExportFormat::Mitsuba06}},
        {"--to mitsuba06 --stddev 0.2 --block-samples 9",
         {.to = ExportFormat::Mitsuba06, .stddev = 0.2, .block_samples = 9}}};
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const auto& [words, options] = cases[i];
        run(str("export knit.vdb ", words, " -o command_", i));
        export_volume(file("knit.vdb"), file(str("job_", i)), options, silent_);
        const std::map<std::string, std::string> files = files_of(file(str("command_", i)));
        EXPECT_GE(files.size(), 3u) << words;
        EXPECT_TRUE(files == files_of(file(str("job_", i)))) << words;
    }
}

TEST_F(CommandAndJob, MaterialEditsAsTheJobDoes) {
    voxelize_knit();
    const std::string hash = content_hash(file("knit.vdb"));
    run("material knit.vdb --set 0.albedo=0.8,0.2,0.1 --set 0.roughness=0.25 --set 0.name=red "
        "-o command.vdb");
    const EditMaterialsOptions options{.set = {{.material = "0", .albedo = Vec3f{0.8f, 0.2f, 0.1f}},
                                               {.material = "0", .roughness = 0.25f},
                                               {.material = "0", .name = "red"}},
                                       .output = file("job.vdb")};
    const MaterialReport report = edit_materials_of_file(file("knit.vdb"), options, silent_);
    EXPECT_EQ(text_of(read_infos(file("command.vdb"))[0].materials), text_of(report.materials));
    EXPECT_EQ(content_hash(file("command.vdb")), hash);
    EXPECT_EQ(content_hash(file("job.vdb")), hash);
}

TEST_F(CommandAndJob, GenerateSliceAndPreviewWriteTheFilesOfTheJob) {
    run("generate hair --counts 20,4 --seed 9 -o command.hair");
    generate_to_file({.kind = GenerateKind::Hair, .nx = 20, .ny = 4, .seed = 9}, file("job.hair"),
                     silent_);
    EXPECT_EQ(slurp(file("command.hair")), slurp(file("job.hair")));
    run("slice cotton --size 64 -o command.png");
    slice_yarn_to_files("cotton", {.image = file("job.png")}, {.size = 64}, silent_);
    EXPECT_EQ(slurp(file("command.png")), slurp(file("job.png")));
    voxelize_knit();
    run("preview knit.vdb --size 32x24 --level 1 -o command.png");
    PreviewOptions options;
    options.width = 32;
    options.height = 24;
    preview_volume_to_file(file("knit.vdb"), file("job.png"), 1, options, silent_);
    EXPECT_EQ(slurp(file("command.png")), slurp(file("job.png")));
}

} // namespace
} // namespace heddle::job
