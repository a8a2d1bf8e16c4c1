#include <heddle/base/nearest_name.h>

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace heddle {
namespace {

TEST(NearestName, ANearNameIsFoundAndAFarOneIsNot) {
    const std::array<std::string, 3> names{"--voxels", "--voxel-size", "--lobes"};
    EXPECT_EQ(nearest_name("--voxles", names), "--voxels");
    EXPECT_EQ(nearest_name("--voxelsize", names), "--voxel-size");
    EXPECT_EQ(nearest_name("--zzzzzzzz", names), "");
    EXPECT_EQ(nearest_name(std::string(65, '-'), names), "");
}

TEST(NearestName, ASwapOfNeighboursIsOneEdit) {
    EXPECT_EQ(edit_distance("voxles", "voxels"), 1u);
    EXPECT_EQ(edit_distance("abc", ""), 3u);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

} // namespace
} // namespace heddle
