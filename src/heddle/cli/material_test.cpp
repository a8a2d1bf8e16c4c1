#include <heddle/cli/commands.h>
#include <heddle/cli/terminal/command_line.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/io/file/test_files.h>
#include <heddle/io/vdb/content_hash.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/voxel/test_grid.h>

#include <gtest/gtest.h>

namespace heddle::cli {
namespace {

/// A small helix of the materials "cotton", "" and "a.b", the last a surface.
class MaterialCommand : public ::testing::Test {
protected:
    void SetUp() override {
        VoxelGrid grid = heddle::testing::make_helix(6.0, 1.0, 1);
        grid.info().materials[0].name = "cotton";
        grid.info().materials[1].name = "";
        grid.info().materials[2].name = "a.b";
        grid.info().materials[2].kind = MaterialKind::Surface;
        path_ = folder_.file("a.vdb");
        Progress progress;
        write_vdb(grid, path_, progress);
        hash_ = content_hash(path_);
    }
    /// Runs `heddle material a.vdb WORDS...`.
    void run(std::vector<std::string> words) {
        words.insert(words.begin(), path_);
        ProgressBar bar(false);
        report_ = {};
        report_.quiet = true;
        const Command command = material_command();
        command.run(parse_arguments(command, words, "heddle material"), report_, bar);
        EXPECT_EQ(content_hash(path_), hash_);
    }
    /// What --set EDIT... is refused with; the file must not have changed.
    std::string refused(const std::vector<std::string>& edits) {
        const std::string before = heddle::testing::slurp(path_);
        std::vector<std::string> words;
        for (const std::string& edit : edits) words.insert(words.end(), {"--set", edit});
        std::string message = "no error";
        try {
            run(words);
        } catch (const UsageError& e) {
            message = e.what();
        }
        EXPECT_EQ(heddle::testing::slurp(path_), before);
        EXPECT_EQ(folder_.count_entries(), 1u);
        return message;
    }
    [[nodiscard]] std::vector<Material> materials() const { return read_infos(path_)[0].materials; }

    heddle::testing::TempFolder folder_;
    std::string path_, hash_;
    Report report_;
};

TEST_F(MaterialCommand, ChangesMaterialsAndNoVoxel) {
    run({"--set", "cotton.albedo=0.8,0.2,0.1", "--set", "cotton.roughness=0.25", "--set",
         "1.name=linen", "--set", "a.b.alpha=0.5"});
    const std::vector<Material> now = materials();
    EXPECT_EQ(now[0].albedo, (Vec3f{0.8f, 0.2f, 0.1f}));
    EXPECT_EQ(now[0].roughness, 0.25f);
    EXPECT_EQ(now[1].name, "linen");
    EXPECT_EQ(now[2].alpha, 0.5f);
    run({"--set", "linen.anisotropy_rotation=-1.5", "--set", "cotton.name=a=b"});
    EXPECT_EQ(materials()[1].anisotropy_rotation, -1.5f);
    EXPECT_EQ(materials()[0].name, "a=b");
}

TEST_F(MaterialCommand, AnotherOutputLeavesTheFileAsItWas) {
    const std::string before = heddle::testing::slurp(path_);
    const std::string other = folder_.file("b.vdb");
    run({"--set", "cotton.metalness=1", "-o", other});
    EXPECT_EQ(heddle::testing::slurp(path_), before);
    EXPECT_EQ(read_infos(other)[0].materials[0].metalness, 1.0f);
    EXPECT_EQ(content_hash(other), hash_);
    EXPECT_THROW(run({"-o", other}), UsageError);
}

TEST_F(MaterialCommand, WithoutSetItListsThem) {
    const std::string before = heddle::testing::slurp(path_);
    run({});
    EXPECT_EQ(heddle::testing::slurp(path_), before);
    report_.quiet = false;
    ::testing::internal::CaptureStdout();
    report_.print();
    const std::string table = ::testing::internal::GetCapturedStdout();
    for (const char* text : {"cotton", "(unnamed)", "a.b", "surface", "0.8,0.3,0.2"}) {
        EXPECT_NE(table.find(text), std::string::npos) << text;
    }
    report_.json = true;
    ::testing::internal::CaptureStdout();
    report_.print();
    const auto json = nlohmann::json::parse(::testing::internal::GetCapturedStdout());
    EXPECT_EQ(json.at("materials").size(), 3u);
    EXPECT_EQ(json.at("materials").at(2).at("name"), "a.b");
}

TEST_F(MaterialCommand, WrongEditsAreRefusedWithWhatWouldBeRight) {
    EXPECT_EQ(refused({"coton.alpha=1"}), "--set: no material 'coton'; did you mean 'cotton'?");
    EXPECT_EQ(refused({"velvet.alpha=1"}),
              "--set: no material 'velvet'; the file has: cotton, 1, a.b");
    EXPECT_EQ(refused({"3.alpha=1"}), "--set: no material '3'; the file has: cotton, 1, a.b");
    EXPECT_EQ(refused({"cotton.albdo=1,1,1"}), "--set: no key 'albdo'; did you mean 'albedo'?");
    EXPECT_NE(refused({"cotton.kind=surface"}).find("no key 'kind'; the keys are: name, albedo"),
              std::string::npos);
    EXPECT_EQ(refused({"cotton.albedo=1,1"}),
              "--set cotton.albedo: '1,1' has 2 numbers; expected 3, separated by ','");
    EXPECT_EQ(refused({"cotton.alpha=1.5"}),
              "--set cotton.alpha: 1.5 is out of range; it must be 0 to 1");
    EXPECT_EQ(refused({"cotton.alpha=nan"}), "--set cotton.alpha: 'nan' is not a number");
    EXPECT_EQ(refused({"cotton.name="}), "--set cotton.name: the value is empty");
    EXPECT_EQ(refused({"cotton"}), "--set: 'cotton' is not NAME.KEY=VALUE");
    EXPECT_EQ(refused({"cotton.alpha"}), "--set: 'cotton.alpha' is not NAME.KEY=VALUE");
    EXPECT_EQ(refused({"cotton.name=a.b"}), "--set: two materials would be named 'a.b'");
    EXPECT_EQ(refused({"cotton.alpha=1", "0.alpha=0.5"}),
              "--set: 'cotton.alpha' is given more than once");
    EXPECT_EQ(refused({"cotton.alpha=0.5", "cotton.alhpa=1"}),
              "--set: no key 'alhpa'; did you mean 'alpha'?");
}

} // namespace
} // namespace heddle::cli
