#include <heddle/io/vol/write_mitsuba06.h>

#include <heddle/base/error.h>
#include <heddle/io/vol/test_vol.h>
#include <heddle/sggx/eigen.h>
#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

namespace heddle {
namespace {

constexpr int kVoxels = 160; ///< along x: across two borders of blocks

Vec3f tangent_of(int i) {
    const double a = 0.13 * i;
    const double b = 0.071 * i;
    return to_float({std::cos(a) * std::sin(b), std::sin(a) * std::sin(b), std::cos(b)});
}

/// A row of fiber voxels along x, each with its own direction and density.
MemoryLevel row() {
    MemoryLevel grid;
    grid.info().lattice = {{0.5, 0.5, 0.5}, 8};
    grid.info().materials.resize(1);
    grid.info().materials[0].kind = MaterialKind::Fiber;
    for (int i = 0; i < kVoxels; i += 8) {
        VoxelBlock& block = grid.blocks.emplace_back();
        VoxelLeaf& leaf = block.leaves.emplace_back();
        leaf.origin = {i - 16, 8, -8};
        for (int k = 0; k < 8; ++k) {
            leaf.active[static_cast<std::size_t>(k)] = 1;
            const Vec3f t = tangent_of(i + k);
            const auto hidden = static_cast<std::uint16_t>(6000 + 300 * (i + k));
            block.coverage.push_back({hidden, hidden, hidden, 30000});
            block.lobe_count.push_back(1);
            const SggxMatrix S =
                fit_sggx({t.x * t.x, t.y * t.y, t.z * t.z, t.x * t.y, t.x * t.z, t.y * t.z});
            block.lobes.push_back({pack(S), 255, 0});
        }
    }
    grid.info().voxel_count = kVoxels;
    grid.info().lobe_count = kVoxels;
    return grid;
}

double extinction_of(const Coverage& c) {
    return -(std::log1p(-c.x / 65535.0) + std::log1p(-c.y / 65535.0) + std::log1p(-c.z / 65535.0)) /
           3.0;
}

TEST(WriteMitsuba06, IsReadBackEqualWithinItsBytes) {
    const testing::TempFolder folder;
    const std::string path = folder.file("out");
    Progress silent;
    const MemoryLevel grid = row();
    const Mitsuba06Files files = write_mitsuba06(grid, path, {}, silent);
    EXPECT_EQ(files.blocks, 3);
    EXPECT_EQ(files.no_fiber, 0);
    EXPECT_EQ(files.samples, (Vec3i{3 * 63 + 1, 64, 64}));
    std::int64_t bytes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path)) {
        bytes += static_cast<std::int64_t>(entry.file_size());
    }
    EXPECT_EQ(bytes, files.bytes);

    VolOptions options;
    options.density_scale = files.scale;
    const VolVolume back = testing::read_path(path + "/volume.vol", options);
    const testing::TestVoxels voxels = testing::voxels_of(*back.grid);
    ASSERT_EQ(voxels.size(), static_cast<std::size_t>(kVoxels));
    for (int i = 0; i < kVoxels; ++i) {
        const testing::TestVoxel& v = voxels.at({i - 16, 8, -8}); // its old index
        const Coverage was{static_cast<std::uint16_t>(6000 + 300 * i),
                           static_cast<std::uint16_t>(6000 + 300 * i),
                           static_cast<std::uint16_t>(6000 + 300 * i), 0};
        // half a byte of density, times 4 / pi and the edge
        EXPECT_NEAR(extinction_of(v.coverage), extinction_of(was), 0.6 / 255.0 * files.scale * 0.5)
            << i;
        const double cosine = std::abs(
            static_cast<double>(dot(principal_direction(unpack(v.lobe.sggx)), tangent_of(i))));
        EXPECT_GT(cosine, std::cos(0.02)) << i; // half a step of each angle, and of packing
    }
}

TEST(WriteMitsuba06, BlocksOfAnySizeAreReadBackAlike) {
    const testing::TempFolder folder;
    Progress silent;
    const MemoryLevel grid = row();
    testing::TestVoxels first;
    for (const std::int32_t edge : {64, 0, 2, 17, 100}) {
        const std::string path = folder.file("out" + std::to_string(edge));
        const Mitsuba06Files files = write_mitsuba06(grid, path, {.block_samples = edge}, silent);
        if (edge == 0) {
            EXPECT_EQ(files.samples, (Vec3i{kVoxels + 2, 3, 3}));
            EXPECT_EQ(files.block_samples, files.samples);
            EXPECT_EQ(files.blocks, 1);
        }
        if (edge == 17) {
            EXPECT_EQ(files.cells, (Vec3i{11, 1, 1})); // 161 steps in blocks of 16
        }
        VolOptions options;
        options.density_scale = files.scale;
        const testing::TestVoxels voxels =
            testing::voxels_of(*testing::read_path(path + "/volume.vol", options).grid);
        if (first.empty()) first = voxels;
        ASSERT_EQ(voxels.size(), first.size()) << edge;
        for (const auto& [at, v] : voxels) {
            EXPECT_EQ(v.coverage, first.at(at).coverage) << edge;
            EXPECT_EQ(v.lobe.sggx, first.at(at).lobe.sggx) << edge;
        }
    }
}

TEST(WriteMitsuba06, TheSceneNamesTheFilesAndTheScale) {
    const testing::TempFolder folder;
    const std::string path = folder.file("out");
    Progress silent;
    (void)write_mitsuba06(row(), path, {.stddev = 0.25}, silent);
    std::ifstream in(path + "/scene.xml");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    for (const char* part : {"hgridvolume", "value=\"density_\"", "value=\"orientation_\"",
                             "value=\"volume.vol\"", "\"stddev\" value=\"0.25\"", "microflake"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part;
    }
}

TEST(WriteMitsuba06, SurfacesHaveNoDirectionAndNothingIsAnError) {
    const testing::TempFolder folder;
    Progress silent;
    MemoryLevel grid = row();
    grid.info().materials[0].kind = MaterialKind::Surface;
    EXPECT_EQ(write_mitsuba06(grid, folder.file("out"), {}, silent).no_fiber, kVoxels);
    EXPECT_THROW((void)write_mitsuba06(MemoryLevel{}, folder.file("none"), {}, silent), Error);
    grid.blocks.back().leaves.back().origin = {70000, 8, -8};
    EXPECT_THROW((void)write_mitsuba06(grid, folder.file("far"), {}, silent), Error);
}

} // namespace
} // namespace heddle
