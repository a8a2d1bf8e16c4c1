#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/io/file/test_files.h>
#include <heddle/io/vdb/content_hash.h>
#include <heddle/io/vdb/grid_name.h>
#include <heddle/io/vdb/predict_vdb.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/test_levels.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/voxel/test_grid.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace heddle {
namespace {

namespace fs = std::filesystem;
using testing::expect_same_voxels;
using testing::make_mixed;

class WriteVdb : public ::testing::Test {
protected:
    [[nodiscard]] std::string file(const char* name) const { return folder_.file(name); }
    [[nodiscard]] std::size_t files() const { return folder_.count_entries(); }
    testing::TempFolder folder_;
    Progress progress_;
};

TEST_F(WriteVdb, ReadsBackEveryVoxelAsItWas) {
    const MemoryLevel grid = make_mixed();
    write_vdb(grid, file("a.vdb"), progress_);
    const auto back = read_vdb(file("a.vdb"));
    expect_same_voxels(grid, *back);
    EXPECT_EQ(files(), 1u);
}

TEST_F(WriteVdb, ReadsBackWhatIsKnownOfTheObject) {
    const MemoryLevel grid = make_mixed();
    write_vdb(grid, file("a.vdb"), progress_);
    const VoxelLevelInfo info = read_vdb(file("a.vdb"))->info();
    EXPECT_EQ(info.name, grid.info().name);
    EXPECT_EQ(info.command, grid.info().command);
    EXPECT_EQ(info.lattice.voxel_size, grid.info().lattice.voxel_size);
    EXPECT_EQ(info.lattice.subvoxels, 4);
    EXPECT_TRUE(info.fields.albedo && info.fields.surface && info.fields.tangents);
    EXPECT_EQ(info.voxel_count, grid.info().voxel_count);
    EXPECT_EQ(info.lobe_count, grid.info().lobe_count);
    ASSERT_EQ(info.materials.size(), 2u);
    EXPECT_EQ(info.materials[0].kind, MaterialKind::Fiber);
    EXPECT_EQ(info.materials[1].albedo, grid.info().materials[1].albedo);
    ASSERT_EQ(info.yarns.size(), 1u);
    EXPECT_EQ(info.yarns[0].plies, 3);
    EXPECT_EQ(info.yarns[0].hair_ze.sd, 0.7f);
}

TEST_F(WriteVdb, AGridWithoutFieldsHasNoGridsForThem) {
    MemoryLevel grid = testing::make_helix(10.0, 2.0, 1);
    write_vdb(grid, file("a.vdb"), progress_);
    std::vector<std::string> names;
    for (const GridSummary& g : summarize_vdb(file("a.vdb"))) names.push_back(g.name);
    EXPECT_EQ(names, (std::vector<std::string>{"density", "tangentu", "coverage", "lobe_0"}));
    expect_same_voxels(grid, *read_vdb(file("a.vdb")));
}

TEST_F(WriteVdb, AnEmptyGridIsWrittenAndReadBack) {
    MemoryLevel grid;
    write_vdb(grid, file("a.vdb"), progress_);
    EXPECT_EQ(read_vdb(file("a.vdb"))->blocks.size(), 0u);
}

TEST_F(WriteVdb, ContentHashDependsOnVoxelsNotOnBlocksOrThreads) {
    set_thread_count(1);
    write_vdb(make_mixed(32), file("a.vdb"), progress_);
    set_thread_count(5);
    write_vdb(make_mixed(16), file("b.vdb"), progress_);
    set_thread_count(0);
    MemoryLevel changed = make_mixed();
    changed.blocks[0].coverage[0].x ^= 1;
    changed.info().fields = {};
    for (VoxelBlock& b : changed.blocks) {
        b.maps.clear();
        b.tangents.clear();
    }
    write_vdb(changed, file("c.vdb"), progress_);
    const auto a = summarize_vdb(file("a.vdb")), c = summarize_vdb(file("c.vdb"));
    // maps depend on the index of a lobe in its block; the other grids must agree
    const auto b = summarize_vdb(file("b.vdb"));
    const auto of = [](const std::vector<GridSummary>& all, const std::string& name) {
        for (const GridSummary& g : all) {
            if (g.name == name) return g;
        }
        return GridSummary{};
    };
    for (const char* name : {"density", "tangentu", "normal", "coverage", "lobe_0", "lobe_2"}) {
        EXPECT_EQ(of(a, name).hash, of(b, name).hash) << name;
        EXPECT_EQ(of(a, name).bytes, of(b, name).bytes) << name;
        EXPECT_GT(of(a, name).active_voxels, 0) << name;
    }
    EXPECT_NE(of(a, "coverage").hash, of(c, "coverage").hash);
    EXPECT_EQ(of(a, "lobe_0").hash, of(c, "lobe_0").hash);
    EXPECT_EQ(content_hash(a).size(), 16u);
    EXPECT_EQ(content_hash(a), content_hash(file("a.vdb")));
    EXPECT_NE(content_hash(a), content_hash(c));
}

TEST_F(WriteVdb, PredictedSizeIsAnUpperBoundAndNotFar) {
    const MemoryLevel grid = testing::make_helix(60.0, 8.0, 2);
    write_vdb(grid, file("a.vdb"), progress_);
    std::int64_t leaves = 0;
    for (const VoxelBlock& b : grid.blocks) leaves += static_cast<std::int64_t>(b.leaves.size());
    const auto size = static_cast<std::int64_t>(fs::file_size(file("a.vdb")));
    const std::int64_t predicted =
        predict_vdb_bytes(leaves, grid.info().voxel_count, grid.info().lobe_count, {}).file;
    EXPECT_LE(size, predicted);
    EXPECT_GT(size * 5, predicted);
}

TEST_F(WriteVdb, ACancelledWriteLeavesTheOldFileAndNothingElse) {
    (void)folder_.write("a.vdb", "old");
    struct CancelLater : Progress {
        void advance(std::int64_t) override { cancel(); }
    } progress;
    EXPECT_THROW(write_vdb(make_mixed(), file("a.vdb"), progress), Error);
    EXPECT_EQ(fs::file_size(file("a.vdb")), 3u);
    EXPECT_EQ(files(), 1u);
}

TEST_F(WriteVdb, AnOutputThatCannotBeWrittenIsOneLine) {
    const MemoryLevel grid = testing::make_helix(10.0, 2.0, 1);
    for (const std::string& path :
         {file("none/a.vdb"), folder_.path(), std::string("/proc/self/a.vdb")}) {
        const auto error = testing::error_of([&] { write_vdb(grid, path, progress_); });
        ASSERT_TRUE(error.has_value()) << path;
        EXPECT_EQ(std::string(error->what()).find(path + ": "), 0u) << error->what();
    }
    EXPECT_EQ(files(), 0u);
}

TEST_F(WriteVdb, AFullDiskIsOneLine) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    testing::expect_error(ErrorCode::CannotWrite, "/dev/full: cannot write: No space left", [&] {
        write_vdb(testing::make_helix(10.0, 2.0, 1), "/dev/full", progress_);
    });
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(WriteVdb, VdbPrintListsTheGrids) {
    if (std::system("command -v vdb_print > /dev/null") != 0) GTEST_SKIP() << "no vdb_print here";
    write_vdb(testing::make_levels(3), file("a.vdb"), progress_);
    ASSERT_EQ(std::system(("vdb_print -l " + file("a.vdb") + " > " + file("list")).c_str()), 0);
    const std::string list = testing::slurp(file("list"));
    for (const char* text : {"Name: density", "Name: lobe_2", "Name: aniso_1", "fog volume",
                             "Name: density_level_2", "Name: merge_level_1"}) {
        EXPECT_NE(list.find(text), std::string::npos) << text;
    }
}

} // namespace
} // namespace heddle
