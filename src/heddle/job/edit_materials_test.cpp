#include <heddle/job/edit_materials.h>

#include <heddle/io/file/test_files.h>
#include <heddle/io/vdb/content_hash.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/job/option_error.h>
#include <heddle/voxel/test_grid.h>

#include <gtest/gtest.h>

namespace heddle::job {
namespace {

/// A small helix of the materials "cotton", "" and "a.b", the last a surface.
class EditMaterials : public ::testing::Test {
protected:
    void SetUp() override {
        MemoryLevel grid = heddle::testing::make_helix(6.0, 1.0, 1);
        grid.info().materials[0].name = "cotton";
        grid.info().materials[1].name = "";
        grid.info().materials[2].name = "a.b";
        grid.info().materials[2].kind = MaterialKind::Surface;
        path_ = folder_.file("a.vdb");
        write_vdb(grid, path_, silent_);
        hash_ = content_hash(path_);
    }
    MaterialReport edit(const std::vector<MaterialEdit>& edits,
                        const std::optional<std::string>& output = {}) {
        MaterialReport report = edit_materials_of_file(path_, {edits, output}, silent_);
        EXPECT_EQ(content_hash(path_), hash_);
        return report;
    }
    /// What the edits are refused with; the file must not have changed.
    std::string refused(const std::vector<MaterialEdit>& edits) {
        const std::string before = heddle::testing::slurp(path_);
        std::string message = "no error";
        try {
            (void)edit(edits);
        } catch (const OptionError& e) {
            message = e.what();
        }
        EXPECT_EQ(heddle::testing::slurp(path_), before);
        EXPECT_EQ(folder_.count_entries(), 1u);
        return message;
    }
    [[nodiscard]] std::vector<Material> materials() const { return read_infos(path_)[0].materials; }

    heddle::testing::TempFolder folder_;
    std::string path_, hash_;
    Progress silent_;
};

TEST_F(EditMaterials, ChangesMaterialsAndNoVoxel) {
    edit({{.material = "cotton", .albedo = Vec3f{0.8f, 0.2f, 0.1f}, .roughness = 0.25f},
          {.material = "1", .name = "linen"},
          {.material = "a.b", .alpha = 0.5f}});
    const std::vector<Material> now = materials();
    EXPECT_EQ(now[0].albedo, (Vec3f{0.8f, 0.2f, 0.1f}));
    EXPECT_EQ(now[0].roughness, 0.25f);
    EXPECT_EQ(now[1].name, "linen");
    EXPECT_EQ(now[2].alpha, 0.5f);
    const MaterialReport report = edit({{.material = "linen", .anisotropy_rotation = -1.5f}});
    EXPECT_EQ(report.file, path_);
    EXPECT_EQ(report.materials[1].anisotropy_rotation, -1.5f);
    EXPECT_EQ(materials()[1].anisotropy_rotation, -1.5f);
}

TEST_F(EditMaterials, AnotherOutputLeavesTheFileAsItWas) {
    const std::string before = heddle::testing::slurp(path_);
    const std::string other = folder_.file("b.vdb");
    EXPECT_EQ(edit({{.material = "cotton", .metalness = 1.0f}}, other).file, other);
    EXPECT_EQ(heddle::testing::slurp(path_), before);
    EXPECT_EQ(read_infos(other)[0].materials[0].metalness, 1.0f);
    EXPECT_EQ(content_hash(other), hash_);
    EXPECT_THROW(edit({}, other), OptionError);
}

TEST_F(EditMaterials, WithoutEditsItReadsThem) {
    const std::string before = heddle::testing::slurp(path_);
    EXPECT_EQ(edit({}).materials.size(), 3u);
    EXPECT_EQ(heddle::testing::slurp(path_), before);
}

TEST_F(EditMaterials, AnisotropyWithoutTangentsIsNoted) {
    const MaterialReport report = edit({{.material = "a.b", .anisotropy = 0.5f}});
    ASSERT_EQ(report.notes.size(), 1u);
    EXPECT_NE(report.notes[0].find("the anisotropy of 'a.b' needs tangents"), std::string::npos);
}

TEST_F(EditMaterials, WrongEditsAreRefusedWithWhatWouldBeRight) {
    EXPECT_EQ(refused({{.material = "coton", .alpha = 1.0f}}),
              "`set`: no material 'coton'; did you mean 'cotton'?");
    EXPECT_EQ(refused({{.material = "velvet", .alpha = 1.0f}}),
              "`set`: no material 'velvet'; the file has: cotton, 1, a.b");
    EXPECT_EQ(refused({{.material = "3", .alpha = 1.0f}}),
              "`set`: no material '3'; the file has: cotton, 1, a.b");
    EXPECT_EQ(refused({{.material = "cotton", .name = "a.b"}}),
              "`set`: two materials would be named 'a.b'");
    EXPECT_EQ(refused({{.material = "cotton", .alpha = 1.0f}, {.material = "0", .alpha = 0.5f}}),
              "`set`: 'cotton.alpha' is given more than once");
    EXPECT_EQ(refused({{.material = "cotton", .alpha = 1.5f}}),
              "`set`: 'cotton.alpha' is 1.5; it must be 0 to 1");
    EXPECT_NE(refused({{.material = "cotton", .albedo = Vec3f{2.0f, 0.0f, 0.0f}}}), "no error");
    EXPECT_NE(refused({{.material = "cotton", .name = ""}}), "no error");
}

TEST_F(EditMaterials, ACancelledOneChangesNothing) {
    const std::string before = heddle::testing::slurp(path_);
    silent_.cancel();
    EXPECT_THROW(edit({{.material = "cotton", .metalness = 1.0f}}), Error);
    EXPECT_EQ(heddle::testing::slurp(path_), before);
    EXPECT_EQ(folder_.count_entries(), 1u);
}

} // namespace
} // namespace heddle::job
