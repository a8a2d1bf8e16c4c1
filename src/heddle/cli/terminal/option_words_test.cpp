#include <heddle/cli/terminal/option_words.h>

#include <gtest/gtest.h>

namespace heddle::cli {
namespace {

TEST(OptionWords, NamesOfOptionsGetTheirDashes) {
    const std::vector<std::string> keys{"voxel-size", "voxels"};
    EXPECT_EQ(in_option_words("`voxel_size` and `voxels`; give one", keys),
              "--voxel-size and --voxels; give one");
    EXPECT_EQ(in_option_words("`voxels`", keys), "--voxels");
}

TEST(OptionWords, AllElseStays) {
    const std::vector<std::string> keys{"voxels"};
    for (const char* text : {"", "`", "a`b", "`other` and voxels", "``", "voxels"}) {
        EXPECT_EQ(in_option_words(text, keys), text);
    }
}

} // namespace
} // namespace heddle::cli
