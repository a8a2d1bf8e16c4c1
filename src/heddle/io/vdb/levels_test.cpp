#include <heddle/base/error.h>
#include <heddle/io/file/test_files.h>
#include <heddle/io/vdb/content_hash.h>
#include <heddle/io/vdb/predict_vdb.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/test_levels.h>
#include <heddle/io/vdb/vdb_file.h>
#include <heddle/io/vdb/vdb_format.h>
#include <heddle/io/vdb/write_vdb.h>

#include <gtest/gtest.h>

#include <filesystem>

namespace heddle {
namespace {

using testing::expect_error;
using testing::grid_of;
using testing::make_levels;

class VdbLevels : public ::testing::Test {
protected:
    [[nodiscard]] std::string file(const char* name) const { return folder_.file(name); }
    [[nodiscard]] std::string write(const VoxelLevels& levels) {
        write_vdb(levels, file("levels.vdb"), progress_);
        return file("levels.vdb");
    }
    /// Writes three levels, replaces every `from` in the bytes, and expects reading to say `text`.
    void expect_refused(const std::string& from, const std::string& to, const std::string& text) {
        ASSERT_EQ(from.size(), to.size());
        std::string bytes = testing::slurp(write(make_levels(3)));
        std::size_t found = 0;
        for (std::size_t at = 0; (at = bytes.find(from, at)) != std::string::npos; ++found) {
            bytes.replace(at, from.size(), to);
            at += to.size();
        }
        ASSERT_GT(found, 0u) << from;
        const std::string path = folder_.write("bad.vdb", bytes);
        expect_error(ErrorCode::BadFile, text, [&] { (void)read_levels(path); });
    }
    /// Writes three levels that `change` has broken, and expects reading to report `text`.
    template <typename Change>
    void expect_broken(const Change& change, const std::string& text) {
        const VoxelLevels levels = make_levels(3);
        change(levels);
        const std::string path = write(levels);
        expect_error(ErrorCode::BadFile, text, [&] { (void)read_levels(path); });
    }

    testing::TempFolder folder_;
    Progress progress_;
};

TEST_F(VdbLevels, EveryArrayOfEveryLevelReadsBackAsItWas) {
    for (const std::int32_t footprints : {0, 4, 8}) {
        const VoxelLevels levels = make_levels(4, footprints, {-9000, -40, 130});
        const VoxelLevels back = read_levels(write(levels));
        ASSERT_EQ(back.size(), 4u);
        for (std::size_t i = 0; i < levels.size(); ++i) {
            testing::expect_same_voxels(grid_of(levels, i), grid_of(back, i));
            EXPECT_EQ(grid_of(back, i).blocks[0].columns.empty(), i > 0);
        }
    }
}

TEST_F(VdbLevels, InfosOfLevelsDifferInLatticeLevelAndCountsAlone) {
    VoxelLevels levels = make_levels(3, 4);
    grid_of(levels, 2) = testing::make_helix(10.0, 2.0, 1);
    VoxelLevelInfo& coarse = grid_of(levels, 2).info();
    const std::int64_t voxels = coarse.voxel_count;
    coarse = grid_of(levels, 1).info();
    coarse.level = 2;
    coarse.lattice = lattice_of_level(levels[0]->info().lattice, 2);
    coarse.materials.resize(3);
    testing::add_fields(grid_of(levels, 2));
    testing::add_level_arrays(grid_of(levels, 2));
    grid_of(levels, 0).info().materials.resize(3);
    grid_of(levels, 0).info().approximate = true;

    const std::vector<VoxelLevelInfo> infos = read_infos(write(levels));
    ASSERT_EQ(infos.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(infos[i].level, static_cast<std::int32_t>(i));
        EXPECT_EQ(infos[i].lattice.voxel_size, levels[i]->info().lattice.voxel_size);
        EXPECT_EQ(infos[i].lattice.subvoxels, 4 << i);
        EXPECT_EQ(infos[i].lod, "moments");
        EXPECT_TRUE(infos[i].approximate);
        EXPECT_TRUE(infos[i].fields.masks && infos[i].fields.correlation && infos[i].fields.albedo);
        EXPECT_EQ(infos[i].fields.footprints, 4);
        EXPECT_EQ(infos[i].materials.size(), 3u);
    }
    EXPECT_EQ(infos[1].voxel_count, levels[1]->info().voxel_count);
    EXPECT_EQ(infos[2].voxel_count, voxels);
}

TEST_F(VdbLevels, OneLevelIsReadAloneAndOneThatIsNotThereIsRefused) {
    const VoxelLevels levels = make_levels(3);
    const std::string path = write(levels);
    testing::expect_same_voxels(grid_of(levels, 2), *read_vdb(path, 2));
    expect_error(ErrorCode::NotFound, "has no level 3; its levels are 0 to 2",
                 [&] { (void)read_vdb(path, 3); });
}

TEST_F(VdbLevels, BlocksAreAlignedCellsOf32Voxels) {
    const auto grid = read_vdb(write(make_levels(1)));
    for (const VoxelBlock& block : grid->blocks) {
        for (const VoxelLeaf& leaf : block.leaves) {
            for (int a = 0; a < 3; ++a) {
                EXPECT_EQ(leaf.origin[a] >> 5, block.leaves[0].origin[a] >> 5);
            }
        }
    }
}

TEST_F(VdbLevels, GridsStandLevelByLevelInTheFile) {
    VoxelLevels levels = make_levels(2, 4);
    std::vector<std::string> names, want{"density", "tangentu", "normal", "coverage"};
    want.insert(want.end(), {"columns_x", "columns_y", "columns_z"});
    want.insert(want.end(), {"footprint", "occupancy", "correlation", "slab", "merge"});
    for (const std::string k : {"0", "1", "2"}) {
        for (const char* kind : {"lobe_", "albedo_", "surface_", "aniso_"}) {
            want.push_back(kind + k);
        }
        for (int j = 0; j < 19; ++j) want.push_back(str("sums_", k, "_", j));
    }
    for (const char* kind :
         {"density",  "tangentu",  "normal",  "coverage", "footprint", "occupancy", "correlation",
          "slab",     "merge",     "lobe_0",  "albedo_0", "surface_0", "aniso_0",   "lobe_1",
          "albedo_1", "surface_1", "aniso_1", "lobe_2",   "albedo_2",  "surface_2", "aniso_2"}) {
        want.push_back(str(kind, "_level_1"));
    }
    for (const GridSummary& g : summarize_vdb(write(levels))) {
        names.push_back(g.name);
        EXPECT_EQ(g.level, g.name.ends_with("_level_1") ? 1 : 0);
    }
    EXPECT_EQ(names, want);
}

TEST_F(VdbLevels, WithoutMergeOrdersThereIsNoGridOfThem) {
    VoxelLevels levels = make_levels(2);
    for (VoxelBlock& b : grid_of(levels, 1).blocks) b.merge_order.clear();
    const VoxelLevels back = read_levels(write(levels));
    for (const VoxelBlock& b : grid_of(back, 1).blocks) EXPECT_TRUE(b.merge_order.empty());
    testing::expect_same_voxels(grid_of(levels, 0), grid_of(back, 0));
}

TEST_F(VdbLevels, TheHashSeesEveryArray) {
    const std::string hash = content_hash(write(make_levels(2)));
    const auto changed = [&](auto change) {
        const VoxelLevels levels = make_levels(2);
        change(grid_of(levels, 0).blocks[1], grid_of(levels, 1).blocks[1]);
        return content_hash(write(levels));
    };
    EXPECT_EQ(changed([](VoxelBlock&, VoxelBlock&) {}), hash);
    EXPECT_NE(changed([](VoxelBlock&, VoxelBlock& b) { b.coverage[0].z ^= 1; }), hash);
    EXPECT_NE(changed([](VoxelBlock& a, VoxelBlock&) { a.columns[0][2] ^= 1; }), hash);
    EXPECT_NE(changed([](VoxelBlock& a, VoxelBlock&) { a.moments[0].weight ^= 1; }), hash);
    EXPECT_NE(changed([](VoxelBlock& a, VoxelBlock&) { a.map_sums[0].anisotropy ^= 1; }), hash);
    EXPECT_NE(changed([](VoxelBlock&, VoxelBlock& b) { b.footprints[0][1] ^= 1; }), hash);
    EXPECT_NE(changed([](VoxelBlock&, VoxelBlock& b) { b.occupancy[0] ^= 1; }), hash);
    EXPECT_NE(changed([](VoxelBlock&, VoxelBlock& b) { b.correlation[0][1] ^= 1; }), hash);
}

TEST_F(VdbLevels, LevelsThatAreMissingDoubledOrOutOfPlaceAreRefused) {
    expect_refused("coverage_level_1", "coverags_level_1", "level 1 is missing");
    expect_refused("coverage_level_2", "coverage_level_1",
                   "grid 'coverage_level_1' is there twice");
    expect_refused("lobe_1_level_1", "lobe_0_level_1", "grid 'lobe_0_level_1' is there twice");
    expect_refused("coverage_level_2", "coverage_level_5",
                   "grid 'coverage_level_5' is of no level");
    expect_refused("coverage_level_2", "coverage_level_0",
                   "grid 'coverage_level_0' is of no level");
    const std::string head = "heddle_levels" + testing::bytes(std::uint32_t{5}) + "int32" +
                             testing::bytes(std::uint32_t{4});
    expect_refused(head + testing::bytes(3), head + testing::bytes(4),
                   "heddle_levels says 4, heddle_info lists 3");
    expect_refused("\"levels\"", "\"lovels\"", "heddle_levels says 3, heddle_info lists 1");
    const std::string count = str("\"voxel_count\":", make_levels(1)[0]->info().voxel_count);
    std::string other = count;
    other.back() = other.back() == '1' ? '2' : '1';
    expect_refused(count, other, " voxels and ");
}

TEST_F(VdbLevels, AFileWithOccupancyOrSlabsIsOfFormat3AndOneWithoutOfFormat2) {
    for (const bool occupancy : {true, false}) {
        for (const bool slabs : {true, false}) {
            VoxelLevels levels = make_levels(2);
            for (std::size_t i = 0; i < 2; ++i) {
                VoxelFields& fields = grid_of(levels, i).info().fields;
                fields.occupancy = occupancy;
                fields.slabs = slabs;
                for (VoxelBlock& block : grid_of(levels, i).blocks) {
                    if (!occupancy) block.occupancy = {};
                    if (!slabs) block.slabs = {};
                }
            }
            const std::string format = read_contents(write(levels)).metadata.at(kFormatKey);
            EXPECT_EQ(format, occupancy || slabs ? "3" : "2");
            const VoxelFields fields = read_infos(file("levels.vdb"))[1].fields;
            EXPECT_EQ(fields.occupancy, occupancy);
            EXPECT_EQ(fields.slabs, slabs);
            const VoxelLevels back = read_levels(file("levels.vdb"));
            testing::expect_same_voxels(grid_of(levels, 1), grid_of(back, 1));
        }
    }
}

TEST_F(VdbLevels, ANewerFormatIsRefusedInOneLine) {
    std::string bytes = testing::slurp(write(make_levels(2)));
    const std::size_t key = bytes.find(kFormatKey);
    const std::size_t value = bytes.find(testing::bytes(std::int32_t{4}, std::int32_t{3}), key);
    ASSERT_NE(value, std::string::npos);
    bytes[value + 4] = 4;
    const std::string path = folder_.write("new.vdb", bytes);
    expect_error(ErrorCode::Unsupported, "format version 4 (allowed: 2 and 3)",
                 [&] { (void)read_infos(path); });
}

TEST_F(VdbLevels, AFileFromBeforeThereWereLevelsReadsAsOne) {
    MemoryLevel grid = testing::make_mixed();
    write_vdb(grid, file("new.vdb"), progress_);
    std::string bytes = testing::slurp(file("new.vdb"));
    for (const char* key : {"\"levels\"", "\"lod\"", "\"approximate\""}) {
        bytes[bytes.find(key) + 1] = '_';
    }
    const VoxelLevels back = read_levels(folder_.write("old.vdb", bytes));
    ASSERT_EQ(back.size(), 1u);
    testing::expect_same_voxels(grid, grid_of(back, 0));
}

TEST_F(VdbLevels, GridsThatAreMissingAreRefused) {
    expect_refused("columns_y", "solumns_y", "grid 'columns_y' is missing");
    expect_refused("sums_1_4", "dums_1_4", "grid 'sums_1_4' is missing");
    expect_refused("sums_2_18", "dums_2_18", "grid 'sums_2_18' is missing");
    expect_refused("lobe_0_level_2", "mobe_0_level_2", "grid 'lobe_0_level_2' is missing");
    expect_refused("aniso_1_level_1", "enisa_1_level_1", "grid 'aniso_1_level_1' is missing");
    expect_refused("footprint_z_level_2", "hootprint_z_level_2",
                   "grid 'footprint_z_level_2' is missing");
    expect_refused("occupancy_level_2", "uccupancy_level_2", "grid 'occupancy_level_2' is missing");
    expect_refused("correlation_level_1", "borrelation_level_1",
                   "grid 'correlation_level_1' is missing");
    expect_refused("lobe_2_level_2", "mobe_2_level_2", "level 2 holds");
}

TEST_F(VdbLevels, LobesMaterialsAndMergeOrdersThatCannotBeAreRefused) {
    const auto three_lobes = [](const VoxelBlock& b) {
        std::size_t v = 0, l = 0;
        while (b.lobe_count[v] < 3) l += b.lobe_count[v++];
        return std::pair(v, l);
    };
    const auto block = [](const VoxelLevels& levels) -> VoxelBlock& {
        for (VoxelBlock& b : grid_of(levels, 1).blocks) {
            if (std::count(b.lobe_count.begin(), b.lobe_count.end(), 3) > 0) return b;
        }
        throw std::runtime_error("no voxel of three lobes");
    };
    expect_broken(
        [&](const VoxelLevels& levels) {
            VoxelBlock& b = block(levels);
            b.merge_order[three_lobes(b).first] = 2;
        },
        "of level 1 merges lobe 2 into lobe 2 (allowed: 0 to 1)");
    expect_broken(
        [&](const VoxelLevels& levels) {
            VoxelBlock& b = block(levels);
            b.lobes[three_lobes(b).second + 2].material = 2;
        },
        "of level 1 names material 2 of 2");
    expect_broken(
        [&](const VoxelLevels& levels) {
            VoxelBlock& b = block(levels);
            b.lobes[three_lobes(b).second + 1].weight = 0;
        },
        "has a lobe of weight 0");
}

TEST_F(VdbLevels, PlanesThatDescendAreRefused) {
    expect_broken(
        [&](const VoxelLevels& l) {
            grid_of(l, 1).blocks[0].slabs[3] = {9, 8};
        },
        "of level 1 has planes 9 and 8 (allowed: ascending)");
    expect_refused("slab_level_2", "slob_level_2", "grid 'slab_level_2' is missing");
}

TEST_F(VdbLevels, CutAndFlippedBytesGiveAnErrorOrVoxelsNeverACrash) {
    const std::string whole = testing::slurp(write(make_levels(2)));
    int refused = 0;
    for (std::uint64_t i = 0; i < 30; ++i) {
        std::string bad = whole;
        bad[hash64(1, i) % bad.size()] ^= static_cast<char>(1 + hash64(2, i) % 255);
        const std::string path = folder_.write("bad.vdb", bad);
        refused += testing::error_of([&] { (void)read_levels(path); }).has_value();
        const std::string cut =
            folder_.write("cut.vdb", whole.substr(0, hash64(3, i) % whole.size()));
        EXPECT_TRUE(testing::error_of([&] { (void)read_levels(cut); }).has_value());
    }
    EXPECT_GT(refused, 6);
}

TEST_F(VdbLevels, LevelsOffTheirLatticeOrOutOfStepAreNotWritten) {
    const auto refused = [&](auto change, const std::string& text) {
        VoxelLevels levels = make_levels(2);
        change(levels);
        expect_error(ErrorCode::Internal, text, [&] { (void)write(levels); });
        EXPECT_EQ(folder_.count_entries(), 0u);
    };
    refused([](VoxelLevels& l) { l.clear(); }, "0 levels");
    refused([](VoxelLevels& l) { std::swap(l[0], l[1]); }, "level 1 stands at place 0");
    refused([](VoxelLevels& l) { grid_of(l, 1).info().lattice.subvoxels = 4; }, "off its lattice");
    refused([](VoxelLevels& l) { grid_of(l, 0).blocks[2].columns.pop_back(); }, "arrays");
    refused([](VoxelLevels& l) { grid_of(l, 1).blocks[2].correlation.clear(); }, "arrays");
    refused([](VoxelLevels& l) { grid_of(l, 1).blocks[2].slabs.clear(); }, "arrays");
    refused([](VoxelLevels& l) { grid_of(l, 1).info().fields.footprints = 5; }, "footprints of 5");
}

TEST_F(VdbLevels, PredictedSizeOfLevelsIsAnUpperBoundAndNotFar) {
    const VoxelLevels levels = make_levels(3, 8, {-40, 0, 40});
    std::vector<LevelSize> sizes;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const VoxelLevelInfo& info = levels[i]->info();
        LevelSize& size = sizes.emplace_back(0, info.voxel_count, info.lobe_count);
        for (const VoxelBlock& b : grid_of(levels, i).blocks) {
            size.leaves += static_cast<std::int64_t>(b.leaves.size());
        }
    }
    const auto size = static_cast<std::int64_t>(std::filesystem::file_size(write(levels)));
    const std::int64_t predicted = predict_vdb_bytes(sizes, levels[0]->info().fields).file;
    EXPECT_LE(size, predicted);
    EXPECT_GT(size * 5, predicted);
}

} // namespace
} // namespace heddle
