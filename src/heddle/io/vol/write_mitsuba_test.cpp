#include <heddle/io/vol/write_mitsuba.h>

#include <heddle/base/error.h>
#include <heddle/io/file/test_files.h>
#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace heddle {
namespace {

/// Two voxels of one leaf: a fiber along z at (1, 2, 3), a disc that faces x at (6, 2, 3).
MemoryLevel two_voxels(bool colors) {
    MemoryLevel grid;
    grid.info().lattice = {{0.5, 0.5, 0.25}, 8};
    grid.info().materials.resize(2);
    grid.info().materials[0].kind = MaterialKind::Fiber;
    grid.info().materials[1].albedo = colors ? Vec3f{0.2f, 0.4f, 0.6f} : Vec3f{0.8f, 0.8f, 0.8f};
    grid.info().voxel_count = 2;
    grid.info().lobe_count = 2;
    VoxelBlock& block = grid.blocks.emplace_back();
    VoxelLeaf& leaf = block.leaves.emplace_back();
    leaf.active[1] = std::uint64_t{1} << (2 * 8 + 3);
    leaf.active[6] = leaf.active[1];
    block.coverage = {{32768, 32768, 6554, 9999}, {16384, 0, 0, 9999}};
    block.lobe_count = {1, 1};
    block.lobes = {{pack(fit_sggx({0, 0, 1, 0, 0, 0})), 255, 0},
                   {pack(fit_sggx({1, 0, 0, 0, 0, 0})), 255, 1}};
    return grid;
}

std::vector<Vec3f> albedo_of(const MemoryLevel& grid) {
    std::vector<Vec3f> out;
    for (const Material& m : grid.info().materials) out.push_back(m.albedo);
    return out;
}

struct ReadVol {
    std::array<std::int32_t, 5> head{};
    std::array<float, 6> bounds{};
    std::vector<float> values;
    [[nodiscard]] const float* at(int x, int y, int z) const {
        return values.data() + ((z * head[2] + y) * head[1] + x) * head[4];
    }
};

ReadVol read_back(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream all;
    all << in.rdbuf();
    const std::string bytes = all.str();
    ReadVol out;
    EXPECT_EQ(bytes.substr(0, 4), "VOL\3");
    std::memcpy(out.head.data(), bytes.data() + 4, 20);
    std::memcpy(out.bounds.data(), bytes.data() + 24, 24);
    out.values.resize((bytes.size() - 48) / 4);
    std::memcpy(out.values.data(), bytes.data() + 48, bytes.size() - 48);
    return out;
}

class WriteMitsuba : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = (std::filesystem::temp_directory_path() /
                   str("heddle_mitsuba_", ::testing::UnitTest::GetInstance()->random_seed(), "_",
                       reinterpret_cast<std::uintptr_t>(this)))
                      .string();
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    MitsubaBox write(const MemoryLevel& grid, double pad) {
        const FlakeField field(grid, albedo_of(grid));
        const MitsubaBox box = plan_mitsuba(field, pad);
        Progress progress;
        write_mitsuba(field, box, folder_, progress);
        return box;
    }
    std::string folder_;
};

double mean_along_axes(const float* s, const float* S) {
    return static_cast<double>(*s) *
           (std::sqrt(static_cast<double>(S[0])) + std::sqrt(static_cast<double>(S[1])) +
            std::sqrt(static_cast<double>(S[2]))) /
           3.0;
}

TEST_F(WriteMitsuba, ValuesReadBackAreTheVoxels) {
    const MitsubaBox box = write(two_voxels(false), 1.0);
    EXPECT_EQ(box.low, (Vec3i{0, 1, 2}));
    EXPECT_EQ(box.size, (Vec3i{8, 3, 3}));
    const ReadVol sigma = read_back(folder_ + "/sigma_t.vol");
    const ReadVol S = read_back(folder_ + "/S.vol");
    EXPECT_EQ(sigma.head, (std::array<std::int32_t, 5>{1, 8, 3, 3, 1}));
    EXPECT_EQ(S.head, (std::array<std::int32_t, 5>{1, 8, 3, 3, 6}));
    EXPECT_EQ(sigma.bounds, (std::array<float, 6>{0.0f, 0.5f, 0.5f, 4.0f, 2.0f, 1.25f}));
    ASSERT_EQ(sigma.values.size(), 72u);
    ASSERT_EQ(S.values.size(), 6u * 72u);
    const double depth = (2 * std::log(1 / (1 - 32768 / 65535.0)) / 0.5 +
                          std::log(1 / (1 - 6554 / 65535.0)) / 0.25) /
                         3.0;
    EXPECT_NEAR(mean_along_axes(sigma.at(1, 1, 1), S.at(1, 1, 1)), depth, 1e-3 * depth);
    EXPECT_NEAR(S.at(1, 1, 1)[0], 1.0f, 1e-3f); // flakes around the fiber: normals across it
    EXPECT_NEAR(S.at(1, 1, 1)[1], 1.0f, 1e-3f);
    EXPECT_LT(S.at(1, 1, 1)[2], 0.02f);
    EXPECT_NEAR(S.at(6, 1, 1)[0], 1.0f, 1e-3f); // the disc faces x
    EXPECT_LT(S.at(6, 1, 1)[1], 0.02f);
    EXPECT_EQ(std::count(sigma.values.begin(), sigma.values.end(), 0.0f), 70);
    EXPECT_FALSE(std::filesystem::exists(folder_ + "/albedo.vol"));
    EXPECT_TRUE(std::filesystem::exists(folder_ + "/scene.xml"));
}

TEST_F(WriteMitsuba, DirectionsGrowByTwoVoxelsAndAreNeverZero) {
    write(two_voxels(false), 3.0);
    const ReadVol S = read_back(folder_ + "/S.vol");
    // the box of 8 is enlarged by 8, those of 3 by 3 on each side
    const int x = 8 + 1;
    const int y = 3 + 1;
    const int z = 3 + 1;
    EXPECT_LT(S.at(x, y, z + 1)[2], 0.02f); // grown from the fiber
    EXPECT_LT(S.at(x - 2, y, z)[2], 0.02f);
    EXPECT_EQ(S.at(x - 3, y, z)[2], 1.0f); // isotropic beyond
    for (std::size_t i = 0; i < S.values.size(); i += 6) {
        EXPECT_GT(S.values[i] + S.values[i + 1] + S.values[i + 2], 0.99f);
    }
}

TEST_F(WriteMitsuba, AlbedoIsWrittenWhereItVaries) {
    write(two_voxels(true), 1.0);
    const ReadVol albedo = read_back(folder_ + "/albedo.vol");
    ASSERT_EQ(albedo.head[4], 3);
    EXPECT_NEAR(albedo.at(1, 1, 1)[0], 0.8f, 0.002f);
    EXPECT_NEAR(albedo.at(6, 1, 1)[2], 0.6f, 0.002f);
}

TEST_F(WriteMitsuba, ABoxBeyondMemoryIsRefusedBeforeAnythingIsWritten) {
    const MemoryLevel grid = two_voxels(false);
    const FlakeField field(grid, albedo_of(grid));
    Progress progress;
    EXPECT_THROW(write_mitsuba(field, plan_mitsuba(field, 1e6), folder_, progress), Error);
    EXPECT_FALSE(std::filesystem::exists(folder_));
}

} // namespace
} // namespace heddle
