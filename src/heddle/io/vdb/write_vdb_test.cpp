#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/io/test_files.h>
#include <heddle/io/vdb/content_hash.h>
#include <heddle/io/vdb/grid_name.h>
#include <heddle/io/vdb/predict_vdb.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/voxel/test_grid.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace heddle {
namespace {

namespace fs = std::filesystem;

class WriteVdb : public ::testing::Test {
protected:
    [[nodiscard]] std::string file(const char* name) const { return folder_.file(name); }
    [[nodiscard]] std::size_t files() const { return folder_.count_entries(); }
    testing::TempFolder folder_;
    Progress progress_;
};

/// 1 to 3 lobes, two kinds of material, all fields, negative indices and several nodes of each
/// size.
VoxelGrid make_mixed(int block_voxels = 32) {
    testing::VoxelMap voxels;
    CounterRandom random{3, 1};
    for (const int shift : {-9000, -40, 0, 130, 5000}) {
        for (int i = 0; i < 300; ++i) {
            const auto at = [&](int n) { return shift + static_cast<int>(random.next() % 40) * n; };
            const auto cover = [&] { return static_cast<std::uint16_t>(random.next()); };
            testing::TestVoxel& v = voxels[{at(1), at(2), at(1)}];
            v.coverage = {cover(), cover(), cover(), cover()};
            v.lobes.clear();
            const int n = 1 + static_cast<int>(random.next() % 3);
            for (int l = 0; l < n; ++l) {
                const Vec3f d = normalize(Vec3f{random.uniform() - 0.5f, random.uniform() - 0.5f,
                                                random.uniform() - 0.5f});
                v.lobes.push_back({testing::needle(d), static_cast<std::uint8_t>(200 - l * 60),
                                   static_cast<std::uint8_t>(random.next() % 2)});
            }
        }
    }
    VoxelGrid grid;
    grid.about.name = "mixed \"quoted\"";
    grid.about.lattice = {{0.1, 0.25, 0.3}, 4};
    grid.about.fields = {true, true, true};
    grid.about.materials.resize(2);
    grid.about.materials[0].name = "wool";
    grid.about.materials[0].kind = MaterialKind::Fiber;
    grid.about.materials[1].albedo = {0.1f, 0.2f, 0.3f};
    grid.about.yarns.resize(1);
    grid.about.yarns[0].plies = 3;
    grid.about.yarns[0].hair_ze = {0.1f, 0.7f};
    grid.about.command = "heddle voxelize a.bcc -o a.vdb";
    grid.blocks = testing::make_blocks(voxels, block_voxels);
    testing::add_fields(grid);
    testing::count_voxels(grid);
    return grid;
}

using Leaves = std::map<std::tuple<int, int, int>, std::pair<const VoxelBlock*, const VoxelLeaf*>>;

Leaves leaves_of(const VoxelGrid& grid) {
    Leaves leaves;
    for (const VoxelBlock& b : grid.blocks) {
        for (const VoxelLeaf& l : b.leaves) {
            leaves[{l.origin.x, l.origin.y, l.origin.z}] = {&b, &l};
        }
    }
    return leaves;
}

template <typename T>
std::vector<T> slice(const std::vector<T>& all, std::size_t begin, std::size_t n) {
    if (all.empty()) return {};
    const auto from = all.begin() + static_cast<std::ptrdiff_t>(begin);
    return std::vector<T>(from, from + static_cast<std::ptrdiff_t>(n));
}

void expect_same_voxels(const VoxelGrid& a, const VoxelGrid& b) {
    const Leaves left = leaves_of(a), right = leaves_of(b);
    ASSERT_EQ(left.size(), right.size());
    for (const auto& [origin, from] : left) {
        ASSERT_TRUE(right.contains(origin));
        const auto [p, l] = from;
        const auto [q, m] = right.at(origin);
        ASSERT_EQ(l->active, m->active);
        const std::size_t n = l->voxel_count();
        const auto counts = slice(p->lobe_count, l->first_voxel, n);
        EXPECT_EQ(slice(p->coverage, l->first_voxel, n), slice(q->coverage, m->first_voxel, n));
        ASSERT_EQ(counts, slice(q->lobe_count, m->first_voxel, n));
        std::size_t k = 0;
        for (const std::uint8_t c : counts) k += c;
        EXPECT_EQ(slice(p->lobes, l->first_lobe, k), slice(q->lobes, m->first_lobe, k));
        EXPECT_EQ(slice(p->maps, l->first_lobe, k), slice(q->maps, m->first_lobe, k));
        EXPECT_EQ(slice(p->tangents, l->first_lobe, k), slice(q->tangents, m->first_lobe, k));
    }
}

TEST_F(WriteVdb, ReadsBackEveryVoxelAsItWas) {
    const VoxelGrid grid = make_mixed();
    write_vdb(grid, file("a.vdb"), progress_);
    const auto back = read_vdb(file("a.vdb"));
    expect_same_voxels(grid, *back);
    EXPECT_EQ(files(), 1u);
}

TEST_F(WriteVdb, ReadsBackWhatIsKnownOfTheObject) {
    const VoxelGrid grid = make_mixed();
    write_vdb(grid, file("a.vdb"), progress_);
    const VoxelGridInfo info = read_vdb(file("a.vdb"))->about;
    EXPECT_EQ(info.name, grid.about.name);
    EXPECT_EQ(info.command, grid.about.command);
    EXPECT_EQ(info.lattice.voxel_size, grid.about.lattice.voxel_size);
    EXPECT_EQ(info.lattice.subvoxels, 4);
    EXPECT_TRUE(info.fields.albedo && info.fields.surface && info.fields.tangents);
    EXPECT_EQ(info.voxel_count, grid.about.voxel_count);
    EXPECT_EQ(info.lobe_count, grid.about.lobe_count);
    ASSERT_EQ(info.materials.size(), 2u);
    EXPECT_EQ(info.materials[0].kind, MaterialKind::Fiber);
    EXPECT_EQ(info.materials[1].albedo, grid.about.materials[1].albedo);
    ASSERT_EQ(info.yarns.size(), 1u);
    EXPECT_EQ(info.yarns[0].plies, 3);
    EXPECT_EQ(info.yarns[0].hair_ze.sd, 0.7f);
}

TEST_F(WriteVdb, AGridWithoutFieldsHasNoGridsForThem) {
    VoxelGrid grid = testing::make_helix(10.0, 2.0, 1);
    write_vdb(grid, file("a.vdb"), progress_);
    std::vector<std::string> names;
    for (const GridSummary& g : summarize_vdb(file("a.vdb"))) names.push_back(g.name);
    EXPECT_EQ(names, (std::vector<std::string>{"density", "tangentu", "coverage", "lobe_0"}));
    expect_same_voxels(grid, *read_vdb(file("a.vdb")));
}

TEST_F(WriteVdb, AnEmptyGridIsWrittenAndReadBack) {
    VoxelGrid grid;
    write_vdb(grid, file("a.vdb"), progress_);
    EXPECT_EQ(read_vdb(file("a.vdb"))->blocks.size(), 0u);
}

TEST_F(WriteVdb, ContentHashDependsOnVoxelsNotOnBlocksOrThreads) {
    set_thread_count(1);
    write_vdb(make_mixed(32), file("a.vdb"), progress_);
    set_thread_count(5);
    write_vdb(make_mixed(16), file("b.vdb"), progress_);
    set_thread_count(0);
    VoxelGrid changed = make_mixed();
    changed.blocks[0].coverage[0].x ^= 1;
    changed.about.fields = {};
    for (VoxelBlock& b : changed.blocks) {
        b.maps.clear();
        b.tangents.clear();
    }
    write_vdb(changed, file("c.vdb"), progress_);
    const auto a = summarize_vdb(file("a.vdb")), c = summarize_vdb(file("c.vdb"));
    // maps depend on the lobe's place in its block, the other grids must agree
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
    const VoxelGrid grid = testing::make_helix(60.0, 8.0, 2);
    write_vdb(grid, file("a.vdb"), progress_);
    std::int64_t leaves = 0;
    for (const VoxelBlock& b : grid.blocks) leaves += static_cast<std::int64_t>(b.leaves.size());
    const auto size = static_cast<std::int64_t>(fs::file_size(file("a.vdb")));
    const std::int64_t predicted =
        predict_vdb_bytes(leaves, grid.about.voxel_count, grid.about.lobe_count, {}).file;
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
    const VoxelGrid grid = testing::make_helix(10.0, 2.0, 1);
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
    write_vdb(make_mixed(), file("a.vdb"), progress_);
    ASSERT_EQ(std::system(("vdb_print -l " + file("a.vdb") + " > " + file("list")).c_str()), 0);
    const std::string list = testing::slurp(file("list"));
    for (const char* text : {"Name: density", "Name: lobe_2", "Name: aniso_1", "fog volume"}) {
        EXPECT_NE(list.find(text), std::string::npos) << text;
    }
}

} // namespace
} // namespace heddle
