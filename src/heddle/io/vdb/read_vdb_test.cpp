#include <heddle/base/error.h>
#include <heddle/io/file/test_files.h>
#include <heddle/io/vdb/content_hash.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/voxel/test_grid.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>

namespace heddle {
namespace {

namespace fs = std::filesystem;

std::string temp(const char* name) {
    return (fs::temp_directory_path() / name).string();
}

void put(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

/// The message of the Error that reading throws; empty if there is none.
std::string read_error(const std::string& path) {
    try {
        (void)read_vdb(path);
        return {};
    } catch (const Error& e) {
        return e.what();
    }
}

/// Writes a helix that `change` has broken, and returns the message of reading it.
std::string error_of(const std::function<void(MemoryLevel&)>& change) {
    MemoryLevel grid = testing::make_helix(10.0, 2.0, 1);
    change(grid);
    const std::string path = temp("heddle_read_broken.vdb");
    Progress progress;
    write_vdb(grid, path, progress);
    std::string message = read_error(path);
    fs::remove(path);
    return message;
}

/// One lobe per voxel, all in one node of 128^3: a file of about 50 kB.
MemoryLevel make_small() {
    testing::VoxelMap voxels;
    for (int i = 0; i < 600; ++i) {
        testing::TestVoxel& v = voxels[{i % 13, i % 29, 3 + i / 20}];
        v.coverage = {static_cast<std::uint16_t>(i * 100), 5, 6, 7};
        v.lobes = {{testing::needle({0.6f, 0.8f, 0.0f}), 255, 0}};
    }
    MemoryLevel grid;
    grid.info().materials.resize(1);
    grid.blocks = testing::make_blocks(voxels);
    testing::count_voxels(grid);
    return grid;
}

/// A file of about 40 kB, nearly all of it the masks of the nodes above the only leaf.
MemoryLevel make_one_voxel() {
    testing::VoxelMap voxels;
    testing::TestVoxel& v = voxels[{1, 2, 3}];
    v.coverage = {4, 5, 6, 7};
    v.lobes = {{testing::needle({0.6f, 0.8f, 0.0f}), 255, 0}};
    MemoryLevel grid;
    grid.info().materials.resize(1);
    grid.blocks = testing::make_blocks(voxels);
    testing::count_voxels(grid);
    return grid;
}

TEST(ReadVdb, AnythingElseThanAVdbIsRefused) {
    const std::string path = temp("heddle_read_text.vdb");
    for (const std::string& text : {std::string(), std::string("BCC"), std::string(5000, 'x')}) {
        put(path, text);
        EXPECT_NE(read_error(path).find("not a VDB"), std::string::npos) << read_error(path);
    }
    fs::remove(path);
    EXPECT_NE(read_error(path).find("no such file"), std::string::npos);
    EXPECT_NE(read_error(fs::temp_directory_path().string()).find("is a directory"),
              std::string::npos);
}

TEST(ReadVdb, EveryTruncationAndExtraByteIsRefused) {
    const testing::TempFolder folder;
    const std::string path = folder.file("cut.vdb");
    Progress progress;
    write_vdb(make_one_voxel(), path, progress);
    ASSERT_EQ(read_error(path), "");
    const std::string whole = testing::slurp(path);
    for (std::size_t n = whole.size(); n-- > 0;) {
        fs::resize_file(path, n);
        ASSERT_NE(read_error(path), "") << n;
    }
    put(path, whole + "x");
    EXPECT_NE(read_error(path).find("1 bytes follow"), std::string::npos) << read_error(path);
}

TEST(ReadVdb, FlippedBytesGiveAnErrorOrVoxelsNeverACrash) {
    const std::string path = temp("heddle_read_flip.vdb");
    Progress progress;
    write_vdb(make_small(), path, progress);
    const std::string whole = testing::slurp(path);
    int refused = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
        std::string bad = whole;
        bad[hash64(1, i) % bad.size()] ^= static_cast<char>(1 + hash64(2, i) % 255);
        put(path, bad);
        refused += read_error(path).empty() ? 0 : 1;
    }
    EXPECT_GT(refused, 90);
    fs::remove(path);
}

TEST(ReadVdb, LobesThatCannotBeAreRefused) {
    EXPECT_EQ(error_of([](MemoryLevel&) {}), "");
    EXPECT_NE(error_of([](MemoryLevel& g) { g.blocks[0].lobes[3].weight = 0; }).find("weight 0"),
              std::string::npos);
    EXPECT_NE(error_of([](MemoryLevel& g) {
                  g.blocks[0].lobes[3].sggx.r[0] = g.blocks[0].lobes[3].sggx.r[1] = 255;
              }).find("not positive definite"),
              std::string::npos);
}

} // namespace
} // namespace heddle
