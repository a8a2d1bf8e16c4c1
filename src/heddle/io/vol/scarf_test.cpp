#include <heddle/io/vol/read_vol.h>

#include <heddle/io/vol/test_vol.h>

#include <cstdlib>

namespace heddle {
namespace {

using namespace heddle::testing;

/// The scarf's dictionary and a few of its blocks, unpacked.
TEST(Scarf, ThreeBlocksOfItGiveVoxelsOnOneLattice) {
    const std::string archive = find_data("volume/scarf-part.tar.xz");
    if (archive.empty()) GTEST_SKIP() << "needs volume/scarf-part.tar.xz of the test data";
    const TempFolder folder;
    const std::string unpack =
        "tar xJf '" + archive + "' -C '" + folder.path() +
        "' --strip-components 2 --wildcards '*description.vol' '*_009_001_00[45]-*.vol' '*_009_002_004-*.vol' 2>/dev/null";
    if (std::system(unpack.c_str()) != 0) GTEST_SKIP() << "needs tar and xz";
    expect_error(ErrorCode::BadFile, "lists block 8 0 3", [&] {
        static_cast<void>(find_vol_layout(folder.file("volume_description.vol")));
    });

    const std::string head = slurp(folder.file("volume_description.vol")).substr(0, 36);
    const std::string path =
        folder.write("three.vol", head + bytes(9, 1, 4) + bytes(9, 1, 5) + bytes(9, 2, 4));
    const VolVolume volume = read_path(path);
    EXPECT_EQ(volume.grid->info().lattice.voxel_size, (Vec3d{0.02, 0.02, 0.02}));
    EXPECT_TRUE(has_note(volume, "density scale 100:"));
    EXPECT_FALSE(has_note(volume, "no direction"));
    const TestVoxels voxels = voxels_of(*volume.grid);
    // a block alone has the same voxels as within the three, except in shared layers
    const VolVolume alone = read_path(folder.file("volume_009_001_005-density.vol"));
    std::size_t same = 0;
    const TestVoxels block = voxels_of(*alone.grid);
    for (const auto& [at, voxel] : block) {
        const auto found = voxels.find(at);
        if (found != voxels.end() && found->second == voxel) ++same;
    }
    EXPECT_GT(block.size(), 100'000u);
    EXPECT_GT(same, block.size() - 64 * 64);
    EXPECT_GT(voxels.size(), 2 * block.size());
}

} // namespace
} // namespace heddle
