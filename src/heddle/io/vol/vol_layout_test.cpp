#include <heddle/io/vol/vol_layout.h>

#include <heddle/io/vol/test_vol.h>
#include <heddle/io/vol/vol_dictionary.h>

#include <cmath>

namespace heddle {
namespace {

using namespace heddle::testing;

constexpr Vec3i kBlock{3, 3, 3};
constexpr Vec3f kLo{-5.0f, 2.0f, 7.0f};
constexpr Vec3i kCells{3, 2, 4};

Vec3f corner_of(Vec3i block) {
    return {kLo.x + static_cast<float>(2 * block.x), kLo.y + static_cast<float>(2 * block.y),
            kLo.z + static_cast<float>(2 * block.z)};
}

/// A dictionary with two blocks, density and orientation.
struct Blocks : TempFolder {
    Blocks() {
        path = write("list.vol", dictionary(kLo, kCells, kBlock, {{2, 1, 3}, {0, 1, 2}}));
        for (const auto& [name, at] : {std::pair{"v_002_001_003", Vec3i{2, 1, 3}},
                                       std::pair{"v_000_001_002", Vec3i{0, 1, 2}}}) {
            put(*this, str(name, "-density.vol"), dense_vol(kBlock, corner_of(at)));
            put(*this, str(name, "-orientation.vol"), direction_vol(kBlock, corner_of(at), 7, 7));
        }
    }
    void refused(const std::string& text, const std::string& orientation = {}) const {
        expect_error(ErrorCode::BadFile, text,
                     [&] { static_cast<void>(find_vol_layout(path, orientation)); });
    }
    std::string path;
};

TEST(VolLayout, ADictionarysFilesAreFoundBesideIt) {
    const Blocks blocks;
    const VolLayout layout = find_vol_layout(blocks.path);
    EXPECT_TRUE(layout.hierarchical);
    ASSERT_EQ(layout.blocks.size(), 2u);
    EXPECT_EQ(layout.blocks[0].at, (Vec3i{0, 1, 2}));
    EXPECT_EQ(layout.blocks[0].density, blocks.file("v_000_001_002-density.vol"));
    EXPECT_EQ(layout.blocks[1].orientation, blocks.file("v_002_001_003-orientation.vol"));
    EXPECT_EQ(layout.samples(), (Vec3i{7, 5, 9}));
    EXPECT_EQ(layout.pitch, (Vec3d{1.0, 1.0, 1.0}));
    EXPECT_EQ(layout.orientation_encoding, VolEncoding::Direction);
}

TEST(VolLayout, PitchesThatRoundingMadeDifferAreOne) {
    const TempFolder folder;
    const Vec3i n{1387, 253, 1135}; // the size of the scarf
    const std::string header = vol_header(3, n, 1, {-14.07444668f, -0.11661835f, -9.89516067f},
                                          {13.64555359f, 4.92338181f, 12.78483963f});
    const std::string path = folder.write("a.vol", header);
    std::filesystem::resize_file(path, 48 + sample_count(n)); // a sparse file: takes no space
    EXPECT_EQ(find_vol_layout(path).pitch, (Vec3d{0.02, 0.02, 0.02}));
    const std::string flat = folder.write(
        "b.vol", vol_header(3, {3, 3, 3}, 1, {}, {1.0f, 1.0f, 0.2f}) + std::string(27, '\1'));
    EXPECT_EQ(find_vol_layout(flat).pitch, (Vec3d{0.5, 0.5, 0.1}));
}

TEST(VolLayout, AMissingBlockIsOneLineThatCountsThemAll) {
    const Blocks blocks;
    std::filesystem::remove(blocks.file("v_000_001_002-density.vol"));
    blocks.refused("byte 48: lists block 0 1 2, and its file");
    blocks.refused("is missing (1 of 2 are)");
    std::filesystem::remove(blocks.file("v_002_001_003-density.vol"));
    blocks.refused("no density file '*002_001_003*.vol' stands beside it");
    const Blocks other;
    std::filesystem::remove(other.file("v_002_001_003-orientation.vol"));
    other.refused("byte 36: lists block 2 1 3");
}

TEST(VolLayout, ABlockOfAnotherSizeIsRefused) {
    const Blocks blocks;
    put(blocks, "v_000_001_002-density.vol", dense_vol({3, 4, 3}, corner_of({0, 1, 2})));
    blocks.refused("byte 8: has 3 4 3 samples, the first block has 3 3 3");
    const Blocks other;
    put(other, "v_000_001_002-orientation.vol", direction_vol({4, 3, 3}, kLo, 1, 1));
    other.refused("byte 8: has 4 3 3 samples");
}

TEST(VolLayout, ABlockWithOtherBoundsIsRefused) {
    const Blocks blocks;
    put(blocks, "v_000_001_002-density.vol", dense_vol(kBlock, corner_of({0, 0, 2})));
    blocks.refused("byte 28: reaches from 2 to 4 along y, its place in the dictionary from 4 to 6");
    const Blocks other;
    put(other, "v_000_001_002-orientation.vol", direction_vol(kBlock, corner_of({0, 1, 3}), 1, 1));
    other.refused("byte 32: reaches from 13");
}

TEST(VolLayout, ABlockOfAnotherKindIsRefused) {
    const Blocks blocks;
    put(blocks, "v_002_001_003-density.vol", direction_vol(kBlock, corner_of({2, 1, 3}), 1, 1));
    blocks.refused("byte 20: 3 channels: directions or colours, not density");
    const Blocks other;
    put(other, "v_002_001_003-orientation.vol", dense_vol(kBlock, corner_of({2, 1, 3})));
    other.refused("byte 20: 1 channels of u8: no directions");
}

TEST(VolLayout, OfSeveralSetsTheNameOrTheOptionChooses) {
    const Blocks blocks;
    put(blocks, "v_002_001_003-gloss.vol", dense_vol(kBlock, corner_of({2, 1, 3})));
    EXPECT_EQ(find_vol_layout(blocks.path).blocks[0].density,
              blocks.file("v_000_001_002-density.vol"));
    put(blocks, "w_002_001_003-density.vol", dense_vol(kBlock, corner_of({2, 1, 3})));
    blocks.refused("several sets of files could be its density: 'v_*-density.vol'");

    const Blocks other;
    put(other, "v_000_001_002-spare.vol", direction_vol(kBlock, corner_of({0, 1, 2}), 1, 1));
    put(other, "v_002_001_003-spare.vol", direction_vol(kBlock, corner_of({2, 1, 3}), 1, 1));
    other.refused("several sets of files could be its orientation: 'v_*-orientation.vol'");
    const std::string asked = other.file("v_000_001_002-spare.vol");
    EXPECT_EQ(find_vol_layout(other.path, asked).blocks[1].orientation,
              other.file("v_002_001_003-spare.vol"));
    EXPECT_FALSE(find_vol_layout(other.path, "none").orientation_encoding.has_value());
}

TEST(VolLayout, AGridsDirectionsAreFoundByNameOrOption) {
    const TempFolder folder;
    const std::string path = folder.write("a-density.vol", dense_vol(kBlock, kLo));
    EXPECT_FALSE(find_vol_layout(path).orientation_encoding.has_value());
    const std::string other = folder.write("b.vol", direction_vol(kBlock, kLo, 1, 1));
    EXPECT_EQ(find_vol_layout(path, other).blocks[0].orientation, other);
    const std::string beside = folder.write("a-orientation.vol", direction_vol(kBlock, kLo, 1, 1));
    EXPECT_EQ(find_vol_layout(path).blocks[0].orientation, beside);
    expect_error(ErrorCode::BadFile, "not density",
                 [&] { static_cast<void>(find_vol_layout(other)); });
    expect_error(ErrorCode::NotFound, "missing.vol",
                 [&] { static_cast<void>(find_vol_layout(path, folder.file("missing.vol"))); });
    const std::string larger = folder.write("c.vol", direction_vol({3, 3, 4}, kLo, 1, 1));
    expect_error(ErrorCode::BadFile, "has 3 3 4 samples, the density has 3 3 3",
                 [&] { static_cast<void>(find_vol_layout(path, larger)); });
}

TEST(VolDictionary, EveryTruncationInsideAnEntryIsRefused) {
    const TempFolder folder;
    const std::string whole = dictionary(kLo, kCells, kBlock, {{2, 1, 3}, {0, 1, 2}});
    for (std::size_t n = 0; n < whole.size(); ++n) {
        if (n == 48) continue; // a dictionary of one block
        const std::string path = folder.write("d.vol", whole.substr(0, n));
        expect_error(ErrorCode::BadFile, "byte",
                     [&] { static_cast<void>(read_vol_dictionary(path)); });
    }
    flip_every_bit(folder, "d.vol", whole,
                   [](const std::string& p) { static_cast<void>(find_vol_layout(p)); });
}

TEST(VolDictionary, BlocksOutsideOrTwiceAreRefused) {
    const TempFolder folder;
    const auto refused = [&](const std::string& text, const std::string& whole) {
        const std::string path = folder.write("d.vol", whole);
        expect_error(ErrorCode::BadFile, text,
                     [&] { static_cast<void>(read_vol_dictionary(path)); });
    };
    refused("byte 48: block 0 1 4 lies outside the 3 2 4 blocks",
            dictionary(kLo, kCells, kBlock, {{2, 1, 3}, {0, 1, 4}}));
    refused("byte 36: block -1 0 0 lies outside", dictionary(kLo, kCells, kBlock, {{-1, 0, 0}}));
    refused("byte 60: block 2 1 3 is listed twice, first at byte 36",
            dictionary(kLo, kCells, kBlock, {{2, 1, 3}, {0, 1, 2}, {2, 1, 3}}));
    refused("lists no block", dictionary(kLo, kCells, kBlock, {}));
    refused("0 blocks along y", dictionary(kLo, {1, 1, 1}, kBlock, {}).replace(28, 1, 1, '\0'));
}

TEST(VolDictionary, BlockNamesComeApartAndTogether) {
    const auto name = parse_block_name("data/2010_v_008_000_1003-density.vol");
    ASSERT_TRUE(name.has_value());
    EXPECT_EQ(name->prefix, "data/2010_v_");
    EXPECT_EQ(name->postfix, "-density.vol");
    EXPECT_EQ(name->block, (Vec3i{8, 0, 1003}));
    EXPECT_EQ(name->of({12, 3, 4}), "data/2010_v_012_003_004-density.vol");
    EXPECT_FALSE(parse_block_name("volume_description.vol").has_value());
    EXPECT_FALSE(parse_block_name("v_08_000_003.vol").has_value());
    EXPECT_FALSE(parse_block_name("v_0008_000_003.vol").has_value());
}

} // namespace
} // namespace heddle
