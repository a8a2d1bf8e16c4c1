#include <heddle/io/vol/read_vol.h>

#include <heddle/base/parallel.h>
#include <heddle/io/vol/test_vol.h>
#include <heddle/io/vol/vol_dictionary.h>
#include <heddle/io/vol/vol_medium.h>

#include <algorithm>
#include <cmath>

namespace heddle {
namespace {

using namespace heddle::testing;

TEST(ReadVol, ASampleIsTheVoxelWhoseCentreIsNearest) {
    const TempFolder folder;
    const Vec3i n{3, 2, 2};
    // samples at -7.3, -5.3, -3.3; 0.9, 2.9; 1, 3: centres of 2-unit voxels -4, -3, -2; 0, 1; 0, 1
    const std::string path =
        folder.write("a.vol", vol_header(3, n, 1, {-7.3f, 0.9f, 1.0f}, {-3.3f, 2.9f, 3.0f}) +
                                  std::string("\x40\0\x80\xc0\0\0\0\0\0\0\0\xff", 12));
    const VolVolume volume = read_path(path, {.density_scale = 0.5});
    const TestVoxels voxels = voxels_of(*volume.grid);
    EXPECT_EQ(volume.grid->info().lattice.voxel_size, (Vec3d{2.0, 2.0, 2.0}));
    ASSERT_EQ(voxels.size(), 4u);
    const VolMedium medium({2.0, 2.0, 2.0}, 0.5);
    EXPECT_EQ(voxels.at({-4, 0, 0}).coverage, medium.coverage(64.0f / 255.0f, {}));
    EXPECT_EQ(voxels.at({-2, 0, 0}).coverage, medium.coverage(128.0f / 255.0f, {}));
    EXPECT_EQ(voxels.at({-4, 1, 0}).coverage, medium.coverage(192.0f / 255.0f, {}));
    EXPECT_EQ(voxels.at({-2, 1, 1}).coverage, medium.coverage(1.0f, {}));
    EXPECT_TRUE(has_note(volume, "moved by (0.3, 0.1, 0) scene units")) << volume.notes[0];
    EXPECT_TRUE(has_note(volume, "no directions"));
}

TEST(ReadVol, AVoxelHasItsDirectionsLobeAndOneFiberMaterial) {
    const TempFolder folder;
    const Vec3i n{2, 2, 2};
    const std::string path = folder.write("x-density.vol", dense_vol(n, {}));
    std::string directions = direction_vol(n, {}, 0, 0);
    directions[48 + 2 * 3] = '\xff';
    put(folder, "x-orientation.vol", directions);
    const VolVolume volume = read_path(path, {.albedo = {0.1f, 0.2f, 0.3f}, .max_lobes = 5});
    const TestVoxels voxels = voxels_of(*volume.grid);
    ASSERT_EQ(voxels.size(), 8u);
    EXPECT_EQ(voxels.at({0, 0, 0}).lobe, (Lobe{VolMedium::lobe({0.0f, 0.0f, 1.0f}), 255, 0}));
    EXPECT_EQ(voxels.at({0, 0, 0}).coverage.z, 0);
    EXPECT_EQ(voxels.at({1, 1, 0}).lobe.sggx, VolMedium::lobe({}));
    EXPECT_TRUE(has_note(volume, "1 of 8 voxels have no direction"));
    EXPECT_TRUE(has_note(volume, "density scale 2:"));
    const VoxelLevelInfo& info = volume.grid->info();
    EXPECT_EQ(info.level, 0);
    EXPECT_FALSE(info.approximate);
    EXPECT_EQ(info.max_lobes, 5);
    EXPECT_EQ(info.lattice.subvoxels, 8);
    ASSERT_EQ(info.materials.size(), 1u);
    EXPECT_EQ(info.materials[0].kind, MaterialKind::Fiber);
    EXPECT_EQ(info.materials[0].albedo, (Vec3f{0.1f, 0.2f, 0.3f}));
}

/// A volume of 50 x 40 x 70 samples, as one grid and as blocks of 11 x 14 x 24, and its samples.
struct Both : TempFolder {
    static constexpr Vec3i kCells{5, 3, 3};
    static constexpr Vec3i kSize{11, 14, 24};
    static constexpr Vec3f kLo{-20.25f, -60.5f, 3.75f};

    static std::string density(int x, int y, int z) {
        const int h = (x * 73 + y * 179 + z * 283 + x * y + y * z) % 101;
        return std::string(1, static_cast<char>(h < 50 ? 0 : h));
    }
    static std::string direction(int x, int y, int z) {
        return {static_cast<char>((x * 5 + y * 3 + z) % 256), static_cast<char>((x + y * z) % 256)};
    }
    static Vec3f at(Vec3i sample) {
        return {kLo.x + static_cast<float>(sample.x), kLo.y + static_cast<float>(sample.y),
                kLo.z + static_cast<float>(sample.z)};
    }
    std::string write_pair(const std::string& name, Vec3i start, Vec3i n) const {
        const Vec3i last{start.x + n.x - 1, start.y + n.y - 1, start.z + n.z - 1};
        put(*this, name + "orientation.vol",
            vol_header(4, n, 3, at(start), at(last)) + vol_samples(n, [&](int x, int y, int z) {
                return direction(start.x + x, start.y + y, start.z + z);
            }));
        return write(name + "density.vol", vol_header(3, n, 1, at(start), at(last)) +
                                               vol_samples(n, [&](int x, int y, int z) {
                                                   return density(start.x + x, start.y + y,
                                                                  start.z + z);
                                               }));
    }
    Both() {
        whole = write_pair("", {}, {51, 40, 70});
        std::vector<Vec3i> blocks;
        for (Vec3i b; b.z < kCells.z; ++b.z) {
            for (b.y = 0; b.y < kCells.y; ++b.y) {
                for (b.x = 0; b.x < kCells.x; ++b.x) {
                    blocks.push_back(b);
                    write_pair(BlockName{"b", "-", b}.of(b), {b.x * 10, b.y * 13, b.z * 23}, kSize);
                }
            }
        }
        list = write("list.vol", dictionary(kLo, kCells, kSize, blocks));
    }
    std::string whole, list;
};

TEST(ReadVol, BlocksAndOneGridGiveTheSameVoxels) {
    const Both both;
    const TestVoxels voxels = voxels_of(*read_path(both.whole).grid);
    EXPECT_GT(voxels.size(), 60'000u);
    EXPECT_EQ(voxels, voxels_of(*read_path(both.list).grid));
}

TEST(ReadVol, OccupancyCanBeLeftOut) {
    const Both both;
    EXPECT_FALSE(voxels_of(*read_path(both.whole, {.occupancy = false}).grid).empty());
}

TEST(ReadVol, AnyThreadCountGivesTheSameVoxels) {
    const Both both;
    set_thread_count(1);
    const TestVoxels voxels = voxels_of(*read_path(both.list).grid);
    set_thread_count(5);
    EXPECT_EQ(voxels, voxels_of(*read_path(both.list).grid));
    set_thread_count(0);
}

TEST(ReadVol, BlocksAreAlignedSoThatNoneSharesALeaf) {
    const Both both;
    const VolVolume volume = read_path(both.list);
    VoxelBlock scratch;
    std::vector<Vec3i> corners;
    for (std::size_t i = 0; i < volume.grid->block_count(); ++i) {
        Vec3i corner{1 << 30, 0, 0};
        for (const VoxelLeaf& leaf : volume.grid->block(i, scratch).leaves) {
            Vec3i c;
            for (int a = 0; a < 3; ++a) {
                EXPECT_EQ(leaf.origin[a] & 7, 0);
                c[a] = leaf.origin[a] & ~31;
            }
            EXPECT_TRUE(corner.x == 1 << 30 || corner == c);
            corner = c;
        }
        EXPECT_EQ(std::count(corners.begin(), corners.end(), corner), 0);
        corners.push_back(corner);
    }
    EXPECT_GT(corners.size(), 8u);
}

TEST(ReadVol, WhereBlocksShareALayerTheDenserCounts) {
    const TempFolder folder;
    const Vec3i n{2, 2, 2};
    const std::string path =
        folder.write("l.vol", dictionary({}, {3, 1, 1}, n, {{0, 0, 0}, {1, 0, 0}}));
    put(folder, "v_000_000_000.vol", dense_vol(n, {}, 100));
    put(folder, "v_001_000_000.vol", dense_vol(n, {1.0f, 0.0f, 0.0f}, 50));
    const TestVoxels voxels = voxels_of(*read_path(path, {.density_scale = 1.0}).grid);
    const VolMedium medium({1.0, 1.0, 1.0}, 1.0);
    ASSERT_EQ(voxels.size(), 12u); // the third block is missing
    EXPECT_EQ(voxels.at({0, 0, 0}).coverage, medium.coverage(100.0f / 255.0f, {}));
    EXPECT_EQ(voxels.at({1, 1, 1}).coverage, medium.coverage(100.0f / 255.0f, {}));
    EXPECT_EQ(voxels.at({2, 0, 1}).coverage, medium.coverage(50.0f / 255.0f, {}));
}

TEST(ReadVol, WhatCoversNothingIsLeftOut) {
    const TempFolder folder;
    const std::string path = folder.write("a.vol", dense_vol({2, 2, 2}, {}, 1));
    EXPECT_EQ(voxels_of(*read_path(path, {.density_scale = 1e-3}).grid).size(), 0u);
    EXPECT_EQ(voxels_of(*read_path(path, {.density_scale = 1e-1}).grid).size(), 8u);
    const VolVolume empty = read_path(folder.write("b.vol", dense_vol({40, 2, 2}, {}, 0)));
    EXPECT_EQ(empty.grid->block_count(), 0u);
}

TEST(ReadVol, AVolumeTooFarFromTheOriginIsRefused) {
    const TempFolder folder;
    const Vec3i n{100, 2, 2};
    const std::string path =
        folder.write("a.vol", vol_header(3, n, 1, {1e9f, 0.0f, 0.0f}, {1e9f + 64.0f, 0.5f, 0.5f}) +
                                  std::string(sample_count(n), '\1'));
    expect_error(ErrorCode::BadFile, "at most 2^30", [&] { static_cast<void>(read_path(path)); });
}

TEST(ReadVol, ANumberThatIsNoneStopsIt) {
    const TempFolder folder;
    const Vec3i n{2, 2, 2};
    const std::string path = folder.write("a-density.vol", dense_vol(n, {}));
    put(folder, "a-orientation.vol",
        vol_header(1, n, 3, {}, {1.0f, 1.0f, 1.0f}) + bytes(std::nanf(""), 0.0f, 1.0f) +
            std::string(7 * 12, '\0'));
    expect_error(ErrorCode::BadFile, "byte 48: direction",
                 [&] { static_cast<void>(read_path(path)); });
}

TEST(ReadVol, CancellingStopsIt) {
    const Both both;
    Progress progress;
    progress.cancel();
    expect_error(ErrorCode::Cancelled, "",
                 [&] { static_cast<void>(read_vol(find_vol_layout(both.list), {}, progress)); });
}

} // namespace
} // namespace heddle
