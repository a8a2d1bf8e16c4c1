#include <heddle/job/render/export_volume.h>
#include <heddle/job/render/preview_volume.h>
#include <heddle/job/render/render_scene.h>

#include <heddle/io/image/image.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/job/option_error.h>
#include <heddle/job/test_job.h>
#include <heddle/job/voxelize/voxelize.h>

#include <gtest/gtest.h>

namespace heddle::job {
namespace {

using heddle::testing::slurp;
using heddle::testing::TempFolder;

/// Two yarns as a .vdb.
class PictureJob : public ::testing::Test {
protected:
    void SetUp() override {
        VoxelizeJobOptions options;
        options.voxels = 30;
        options.device = DeviceChoice::Cpu;
        path_ = folder_.file("a.vdb");
        voxelize_to_file({.geometry = test::two_yarns()}, path_, options, silent_);
    }

    TempFolder folder_;
    std::string path_;
    Progress silent_;
};

TEST_F(PictureJob, ThePreviewInAFileIsTheOneInMemory) {
    PreviewOptions options;
    options.width = 32;
    options.height = 24;
    const PreviewImage image = preview_volume(path_, 1, options, silent_);
    const PreviewReport report =
        preview_volume_to_file(path_, folder_.file("a.png"), 1, options, silent_);
    EXPECT_EQ(read_image(folder_.file("a.png")).texels, image.rgba);
    EXPECT_EQ(report.width, 32);
    EXPECT_GT(report.voxels, 0);
    EXPECT_THROW(preview_volume_to_file(path_, folder_.file("a.jpg"), 0, options, silent_),
                 OptionError);
    test::CancelAt progress(0);
    EXPECT_THROW(preview_volume_to_file(path_, folder_.file("b.png"), 0, options, progress), Error);
    EXPECT_EQ(folder_.count_entries(), 2u);
}

TEST_F(PictureJob, TheRenderInAFileIsTheOneInMemory) {
    const RenderOptions options{.samples = 2, .size = PictureSize{16, 12}};
    const Scene scene = load_scene(path_, options);
    const RenderResult made = render_scene(scene, options, silent_);
    const RenderReport report =
        render_scene_to_file(path_, folder_.file("a.png"), options, silent_);
    EXPECT_EQ(made.report.samples, 2);
    EXPECT_EQ(report.samples, 2);
    EXPECT_EQ(report.size.width, 16);
    EXPECT_EQ(read_image(folder_.file("a.png")).texels, to_srgb8(made.picture, 0.0));
    EXPECT_EQ(folder_.count_entries(), 2u) << "no checkpoint is left";
}

TEST_F(PictureJob, ARenderIsRefusedOrCancelled) {
    const RenderOptions options{.samples = 2, .size = PictureSize{16, 12}};
    EXPECT_THROW((void)load_scene(path_, {.geometry = true}), OptionError);
    EXPECT_THROW(render_scene_to_file(path_, folder_.file("a.jpg"), options, silent_), OptionError);
    const Scene scene = load_scene(path_, options);
    EXPECT_THROW((void)render_scene(scene, {.size = PictureSize{0, 5}}, silent_), OptionError);
    EXPECT_THROW((void)render_scene(scene, {.resume = true}, silent_), OptionError);
    for (const std::int64_t n : {0, 1}) {
        test::CancelAt progress(n);
        EXPECT_THROW((void)render_scene(scene, options, progress), Error) << n;
    }
    test::expect_cancelled(folder_, 1, [&](Progress& progress) {
        render_scene_to_file(scene, folder_.file("b.png"), options, progress);
    });
}

TEST_F(PictureJob, AVolumeInMemoryIsExportedAsOneOfAFile) {
    const std::unique_ptr<MemoryLevel> grid = read_vdb(path_, 0);
    for (const ExportFormat to : {ExportFormat::Mitsuba3, ExportFormat::Mitsuba06}) {
        const ExportOptions options{.to = to};
        const ExportReport report = export_volume(path_, folder_.file("file"), options, silent_);
        export_volume(*grid, folder_.file("memory"), options, silent_);
        EXPECT_EQ(report.box.has_value(), to == ExportFormat::Mitsuba3);
        EXPECT_EQ(report.files.has_value(), to == ExportFormat::Mitsuba06);
        const char* name = report.box ? "/sigma_t.vol" : "/volume.vol";
        EXPECT_FALSE(slurp(folder_.file("file") + name).empty());
        EXPECT_EQ(slurp(folder_.file("file") + name), slurp(folder_.file("memory") + name));
    }
    EXPECT_THROW(export_volume(path_, folder_.path(), {.stddev = 0.5}, silent_), OptionError);
    EXPECT_THROW(
        export_volume(path_, folder_.path(), {.to = ExportFormat::Mitsuba06, .pad = 2.0}, silent_),
        OptionError);
    test::CancelAt progress(0);
    EXPECT_THROW(export_volume(path_, folder_.file("none"), {}, progress), Error);
    EXPECT_FALSE(std::filesystem::exists(folder_.file("none")));
}

} // namespace
} // namespace heddle::job
