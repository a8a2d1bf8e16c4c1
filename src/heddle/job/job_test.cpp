#include <heddle/job/generate_geometry.h>
#include <heddle/job/geometry_input.h>
#include <heddle/job/inspect_file.h>
#include <heddle/job/option_error.h>
#include <heddle/job/slice_yarn.h>
#include <heddle/job/write_output.h>

#include <heddle/io/geometry/read_geometry.h>
#include <heddle/io/image/image.h>
#include <heddle/io/yarn/yarn_file.h>
#include <heddle/job/test_job.h>

#include <gtest/gtest.h>

namespace heddle::job {
namespace {

using heddle::testing::TempFolder;

std::string refused(const std::function<void()>& run) {
    try {
        run();
    } catch (const OptionError& e) {
        EXPECT_EQ(e.code(), ErrorCode::InvalidArgument);
        EXPECT_TRUE(e.where().path.empty());
        return e.what();
    }
    return "no error";
}

TEST(GeometryInput, TakesWhatIsInMemoryAndGivesItTheYarn) {
    const Geometry plain = load_geometry({.geometry = test::two_yarns()});
    EXPECT_TRUE(plain.yarns.empty());
    EXPECT_EQ(plain.curves[0].default_radius, 0.2f);
    const Geometry cotton =
        load_geometry({.geometry = test::two_yarns(), .options = {.yarn = "cotton", .fibers = 30}});
    ASSERT_EQ(cotton.yarns.size(), 1u);
    EXPECT_EQ(cotton.yarns[0].fiber_count(), 30);
    const Geometry thick =
        load_geometry({.geometry = test::two_yarns(), .options = {.yarn_radius = 0.5}});
    EXPECT_EQ(thick.curves[0].default_radius, 0.5f);
}

TEST(GeometryInput, OptionsThatDoNotGoTogetherAreRefusedInWords) {
    const auto with = [](const GeometryOptions& options, Geometry geometry) {
        return refused(
            [&] { (void)load_geometry({.geometry = std::move(geometry), .options = options}); });
    };
    EXPECT_EQ(with({.fibers = 3}, test::two_yarns()), "`fibers` needs `yarn`");
    EXPECT_EQ(with({.height_scale = 3.0}, test::square()), "`height_scale` needs `height_map`");
    EXPECT_EQ(with({.yarn = "cotton"}, test::square()),
              "`yarn` needs curves, but the file holds none");
    EXPECT_EQ(with({.yarn_radius = -1.0}, test::two_yarns()),
              "`yarn_radius` is -1; it must be > 0");
    EXPECT_EQ(with({.repeat_x = 2}, test::two_yarns()), "`repeat` needs a file");
}

TEST(CheckOutput, ABadPathIsRefusedBeforeTheWork) {
    const TempFolder folder;
    EXPECT_NE(
        refused([&] { check_output(folder.file("a.png"), ".vdb", "plot"); }).find("`plot`: '"),
        std::string::npos);
    heddle::testing::expect_error(ErrorCode::CannotWrite, "nowhere",
                                  [&] { check_output(folder.file("nowhere/a.vdb"), ".vdb"); });
    heddle::testing::expect_error(ErrorCode::CannotWrite, "a folder or a device",
                                  [&] { check_output(folder.path(), ".vdb"); });
    check_output(folder.file("a.vdb"), ".vdb");
    EXPECT_EQ(folder.count_entries(), 0u);
}

TEST(GenerateGeometry, TheFileHoldsWhatMemoryDoes) {
    const TempFolder folder;
    Progress silent;
    const GenerateOptions options{.nx = 3, .ny = 2};
    const Geometry made = generate_geometry(options, silent);
    const GenerateReport report = generate_to_file(options, folder.file("a.bcc"), silent);
    EXPECT_EQ(report.nodes, static_cast<std::int64_t>(made.curves[0].points.size()));
    EXPECT_GT(report.options.radius, 0.0) << "defaults are in their place";
    EXPECT_EQ(read_geometry(folder.file("a.bcc")).curves[0].points, made.curves[0].points);
    EXPECT_NE(refused([&] {
                  generate_to_file(options, folder.file("a.obj"), silent);
              }).find("must end in .bcc"),
              std::string::npos);
}

TEST(GenerateGeometry, CancelledItLeavesNoFile) {
    const TempFolder folder;
    test::CancelAt progress(0);
    heddle::testing::expect_error(ErrorCode::Cancelled, "cancelled", [&] {
        generate_to_file({.nx = 3, .ny = 2}, folder.file("a.bcc"), progress);
    });
    EXPECT_EQ(folder.count_entries(), 0u);
}

TEST(SliceYarn, TheFilesHoldWhatMemoryDoes) {
    const TempFolder folder;
    Progress silent;
    const SlicedYarn made = slice_yarn("cotton", {.size = 32, .fibers = 30}, silent);
    EXPECT_EQ(made.yarn.model, YarnModel::Slice);
    const SliceFiles files{.image = folder.file("a.png"),
                           .yarn_file = folder.file("a.toml"),
                           .occlusion = folder.file("o.png"),
                           .mipmaps = folder.file("m.png")};
    slice_yarn_to_files("cotton", files, {.size = 32, .fibers = 30}, silent);
    EXPECT_EQ(read_image(files.image).texels, made.yarn.slice.texels);
    EXPECT_EQ(read_image(*files.mipmaps).width, 32 + 16 + 8 + 4 + 2 + 1);
    const YarnFile again =
        read_yarn(*files.yarn_file, [](const std::string& path) { return read_image(path); });
    EXPECT_EQ(again.yarn.slice.texels, made.yarn.slice.texels);
    test::CancelAt progress(0);
    EXPECT_THROW(slice_yarn_to_files("silk", {.image = folder.file("b.png")}, {}, progress), Error);
    EXPECT_EQ(folder.count_entries(), 4u);
}

TEST(InspectFile, SaysWhatIsInMemoryAndInAFile) {
    Progress silent;
    const GeometryInfo info =
        inspect_geometry({.geometry = test::two_yarns()}, {.voxels = 30}, silent);
    ASSERT_TRUE(info.curves && info.plan && !info.meshes);
    EXPECT_EQ(info.curves->sum.curves, 2u);
    EXPECT_GT(info.predicted_file_bytes, 0);
    const GeometryInfo flat =
        inspect_geometry({.geometry = test::square()}, {.voxel_size = Vec3d{1e-9, 1, 1}}, silent);
    EXPECT_FALSE(flat.plan);
    EXPECT_NE(flat.why_not, "");
    EXPECT_NE(refused([&] {
                  (void)inspect_geometry({.geometry = test::square()},
                                         {.voxel_size = Vec3d{1, 1, 1}, .voxels = 5}, silent);
              }),
              "no error");
    const TempFolder folder;
    generate_to_file({.nx = 3, .ny = 2}, folder.file("a.bcc"), silent);
    const FileInfo file = inspect_file(folder.file("a.bcc"), {.voxels = 30}, silent);
    EXPECT_EQ(file.file_bytes, file_bytes(folder.file("a.bcc")));
    EXPECT_TRUE(std::get<GeometryInfo>(file.content).curves.has_value());
}

} // namespace
} // namespace heddle::job
