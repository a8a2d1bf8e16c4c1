#include <heddle/base/error.h>
#include <heddle/io/file/test_files.h>
#include <heddle/io/vdb/content_hash.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/replace_materials.h>
#include <heddle/io/vdb/test_levels.h>
#include <heddle/io/vdb/write_vdb.h>

#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

namespace heddle {
namespace {

class ReplaceMaterials : public ::testing::Test {
protected:
    void SetUp() override {
        path_ = folder_.file("a.vdb");
        write_vdb(levels_, path_, progress_);
        materials_ = levels_[0]->info().materials;
    }
    void replace(const std::string& output) {
        replace_materials(path_, materials_, output, progress_);
    }
    testing::TempFolder folder_;
    Progress progress_;
    VoxelLevels levels_ = testing::make_levels(2);
    std::string path_;
    std::vector<Material> materials_;
};

TEST_F(ReplaceMaterials, NoVoxelOfAnyLevelChanges) {
    const std::string hash = content_hash(path_);
    for (const char* name : {"a name that is a good deal longer than the one before it was", "b"}) {
        materials_[0].name = name;
        materials_[0].albedo = {0.8f, 0.2f, 0.1f};
        materials_[1].roughness = 0.125f;
        replace(path_);
        const VoxelLevels back = read_levels(path_);
        for (std::size_t i = 0; i < 2; ++i) {
            testing::expect_same_voxels(testing::grid_of(levels_, i), testing::grid_of(back, i));
            const std::vector<Material>& now = back[i]->info().materials;
            ASSERT_EQ(now.size(), 2u);
            EXPECT_EQ(now[0].name, name);
            EXPECT_EQ(now[0].albedo, materials_[0].albedo);
            EXPECT_EQ(now[0].kind, MaterialKind::Fiber);
            EXPECT_EQ(now[1].roughness, 0.125f);
            EXPECT_EQ(now[1].albedo, levels_[0]->info().materials[1].albedo);
        }
        EXPECT_EQ(back[0]->info().command, levels_[0]->info().command);
        EXPECT_EQ(content_hash(path_), hash);
        EXPECT_EQ(folder_.count_entries(), 1u);
    }
}

TEST_F(ReplaceMaterials, TheSameMaterialsGiveTheSameBytesInAnotherFile) {
    replace(folder_.file("b.vdb"));
    EXPECT_EQ(testing::slurp(folder_.file("b.vdb")), testing::slurp(path_));
}

TEST_F(ReplaceMaterials, OpenVdbReadsWhatWasWritten) {
    materials_[0].name = "much longer than wool";
    replace(folder_.file("b.vdb"));
    openvdb::initialize();
    openvdb::io::File before(path_), after(folder_.file("b.vdb"));
    before.open(/*delayLoad=*/false);
    after.open(/*delayLoad=*/false);
    for (auto name = before.beginName(); name != before.endName(); ++name) {
        const auto a = before.readGrid(name.gridName()), b = after.readGrid(name.gridName());
        EXPECT_EQ(a->activeVoxelCount(), b->activeVoxelCount()) << name.gridName();
        EXPECT_EQ(a->evalActiveVoxelBoundingBox(), b->evalActiveVoxelBoundingBox());
    }
    const auto density = openvdb::gridPtrCast<openvdb::FloatGrid>(before.readGrid("density"));
    const auto same = openvdb::gridPtrCast<openvdb::FloatGrid>(after.readGrid("density"));
    for (auto voxel = density->cbeginValueOn(); voxel; ++voxel) {
        ASSERT_EQ(same->tree().getValue(voxel.getCoord()), *voxel);
    }
}

TEST_F(ReplaceMaterials, AFileWithoutGridsOrAnotherCountIsHandled) {
    const std::string empty = folder_.file("empty.vdb");
    MemoryLevel grid;
    grid.info().materials.resize(1);
    write_vdb(grid, empty, progress_);
    grid.info().materials[0].name = "dust";
    replace_materials(empty, grid.info().materials, empty, progress_);
    EXPECT_EQ(read_infos(empty)[0].materials[0].name, "dust");
    materials_.resize(3);
    testing::expect_error(ErrorCode::InvalidArgument, "3 materials for a file that has 2",
                          [&] { replace(path_); });
}

TEST_F(ReplaceMaterials, WhatFailsLeavesTheOldFileAndNothingElse) {
    const std::string before = testing::slurp(path_);
    progress_.cancel();
    EXPECT_THROW(replace(path_), Error);
    EXPECT_EQ(testing::slurp(path_), before);
    const std::string cut = folder_.write("cut.vdb", before.substr(0, before.size() / 2));
    EXPECT_THROW(replace_materials(cut, materials_, path_, progress_), Error);
    EXPECT_EQ(testing::slurp(path_), before);
    EXPECT_EQ(folder_.count_entries(), 2u);
}

} // namespace
} // namespace heddle
