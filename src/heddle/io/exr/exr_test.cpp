#include <heddle/io/exr/exr.h>

#include <heddle/io/file/test_files.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTiledRgbaFile.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace heddle {
namespace {

using testing::error_of;
using testing::expect_error;
using testing::TempFolder;

std::vector<float> ramp(std::size_t n, float from, float step) {
    std::vector<float> values(n);
    for (std::size_t i = 0; i < n; ++i) values[i] = from + step * static_cast<float>(i);
    return values;
}

/// A file of 7 x 5 px; red is stored as half, where it is exact.
std::string write_small(const TempFolder& folder, const std::string& name) {
    const std::vector<float> r = ramp(35, 0.0f, 0.25f);
    const std::vector<float> g = ramp(35, 0.1f, 0.3f);
    const std::vector<float> b = ramp(35, -3.0f, 1e-3f);
    const std::vector<ExrChannel> channels{
        {"B", b, false}, {"R", r, true}, {"G", g, false}, {"tangent.X", b, true}};
    write_exr(folder.file(name), 7, 5, channels, {{"heddle:samples", "64"}});
    return folder.file(name);
}

void read(const std::string& path) {
    static_cast<void>(read_exr_rgb(path));
}

TEST(Exr, FloatAndHalfComeBackAsWritten) {
    const TempFolder folder;
    const FloatImage image = read_exr_rgb(write_small(folder, "a.exr"));
    ASSERT_EQ(image.width, 7);
    ASSERT_EQ(image.height, 5);
    ASSERT_EQ(image.values.size(), 105u);
    const std::vector<float> g = ramp(35, 0.1f, 0.3f);
    const std::vector<float> b = ramp(35, -3.0f, 1e-3f);
    for (std::size_t i = 0; i < 35; ++i) {
        EXPECT_EQ(image.values[3 * i], 0.25f * static_cast<float>(i));
        EXPECT_EQ(image.values[3 * i + 1], g[i]);
        EXPECT_EQ(image.values[3 * i + 2], b[i]);
    }
    EXPECT_EQ(folder.count_entries(), 1u);
}

TEST(Exr, AttributesChannelsAndCompressionStandInTheFile) {
    const TempFolder folder;
    const std::string path = write_small(folder, "a.exr");
    const Imf::InputFile file(path.c_str());
    EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);
    EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("heddle:samples").value(), "64");
    const Imf::Channel* tangent = file.header().channels().findChannel("tangent.X");
    ASSERT_NE(tangent, nullptr);
    EXPECT_EQ(tangent->type, Imf::HALF);
    EXPECT_EQ(file.header().channels().findChannel("G")->type, Imf::FLOAT);
}

TEST(Exr, HalfIsClampedAndKeepsNaN) {
    const TempFolder folder;
    const std::vector<float> y{1e9f, -std::numeric_limits<float>::infinity(),
                               std::numeric_limits<float>::quiet_NaN(), 1.0f + 1.0f / 4096.0f};
    const std::vector<ExrChannel> channels{{"Y", y, true}};
    write_exr(folder.file("y.exr"), 2, 2, channels);
    const FloatImage image = read_exr_rgb(folder.file("y.exr"));
    EXPECT_EQ(image.values[0], 65504.0f);
    EXPECT_EQ(image.values[2], 65504.0f) << "grey stands in all three";
    EXPECT_EQ(image.values[3], -65504.0f);
    EXPECT_TRUE(std::isnan(image.values[6]));
    EXPECT_EQ(image.values[9], 1.0f);
}

/// 40 x 20 px in tiles with mip levels, in a window that starts at (-3, 10); green counts up.
std::string write_tiled(const TempFolder& folder, Imf::Compression compression) {
    const Imath::Box2i window({-3, 10}, {36, 29});
    Imf::TiledRgbaOutputFile file(folder.file("t.exr").c_str(), 16, 8, Imf::MIPMAP_LEVELS,
                                  Imf::ROUND_DOWN, window, window, Imf::WRITE_RGB, 1, {0, 0}, 1,
                                  Imf::INCREASING_Y, compression, 0);
    std::vector<Imf::Rgba> pixels(40 * 20, Imf::Rgba(0.0f, 0.0f, 0.0f));
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i].g = static_cast<float>(i);
    file.setFrameBuffer(pixels.data() - (10 * 40 - 3), 1, 40);
    for (int level = 0; level < file.numLevels(); ++level) {
        file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
    }
    return folder.file("t.exr");
}

TEST(Exr, TiledFilesWithMipLevelsAndAnOffsetWindowAreRead) {
    const TempFolder folder;
    const FloatImage image = read_exr_rgb(write_tiled(folder, Imf::PIZ_COMPRESSION));
    ASSERT_EQ(image.width, 40);
    ASSERT_EQ(image.height, 20);
    EXPECT_EQ(image.values[3 * 799 + 1], 799.0f);
    EXPECT_EQ(image.values[3 * 41 + 1], 41.0f);
    EXPECT_EQ(image.values[3 * 41], 0.0f);
}

TEST(Exr, DamagedTilesOfEveryCompressionNeverCrash) {
    for (const Imf::Compression compression :
         {Imf::RLE_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION,
          Imf::DWAA_COMPRESSION}) {
        const TempFolder folder;
        const std::string whole = testing::slurp(write_tiled(folder, compression));
        for (std::size_t i = 0; i < whole.size(); i += 3) {
            std::string bad = whole;
            bad[i] = static_cast<char>(bad[i] ^ (1 << (i / 3) % 8));
            const std::string flipped = folder.write("bad.exr", bad);
            static_cast<void>(error_of([&] { read(flipped); }));
            const std::string cut = folder.write("cut.exr", whole.substr(0, i));
            static_cast<void>(error_of([&] { read(cut); }));
        }
    }
}

TEST(Exr, WhatCannotBeWrittenIsRefused) {
    const TempFolder folder;
    const std::vector<float> v(4);
    const auto refused = [&](int w, int h, const std::vector<ExrChannel>& channels,
                             const ExrAttributes& attributes, const std::string& text) {
        expect_error(ErrorCode::InvalidArgument, text,
                     [&] { write_exr(folder.file("no.exr"), w, h, channels, attributes); });
    };
    refused(0, 4, {{"R", v}}, {}, "0 x 4 px");
    refused(1 << 20, 1 << 20, {{"R", v}}, {}, "2^28");
    refused(2, 2, {}, {}, "0 channels");
    refused(2, 2, {{"", v}}, {}, "has 0 bytes");
    refused(2, 2, {{"R", v}, {"R", v}}, {}, "'R' stands twice");
    refused(3, 2, {{"R", v}}, {}, "has 4 values, 3 x 2 px need 6");
    refused(2, 2, {{"R", v}}, {{"compression", "x"}}, "format's own");
    refused(2, 2, {{"R", v}}, {{"a", "x"}, {"a", "y"}}, "stands twice");
    EXPECT_EQ(folder.count_entries(), 0u);
    const std::vector<ExrChannel> good{{"R", v}};
    expect_error(ErrorCode::NotFound, "folder",
                 [&] { write_exr(folder.file("none/a.exr"), 2, 2, good); });
}

TEST(Exr, OtherFilesAreRefusedWithTheirPath) {
    const TempFolder folder;
    const std::vector<float> v(4);
    const std::vector<ExrChannel> red{{"R", v}, {"depth", v}};
    write_exr(folder.file("red.exr"), 2, 2, red);
    expect_error(ErrorCode::BadFile,
                 "red.exr: has no R, G, B or Y at every pixel; it has: R, depth",
                 [&] { read(folder.file("red.exr")); });
    expect_error(ErrorCode::BadFile, "png: byte 0: is no OpenEXR file",
                 [&] { read(folder.write("a.png", "\x89PNG and more")); });
    expect_error(ErrorCode::NotFound, "no.exr", [&] { read(folder.file("no.exr")); });
}

TEST(Exr, EveryTruncationIsAnError) {
    const TempFolder folder;
    const std::string whole = testing::slurp(write_small(folder, "a.exr"));
    testing::expect_truncations_fail(folder, "cut.exr", whole, read);
}

TEST(Exr, FlippedBitsNeverCrash) {
    const TempFolder folder;
    const std::string whole = testing::slurp(write_small(folder, "a.exr"));
    testing::flip_every_bit(folder, "bad.exr", whole, read);
}

TEST(Exr, SizesThatTheFileCannotHoldAreRefusedBeforeMemoryIsTaken) {
    const TempFolder folder;
    const std::string whole = testing::slurp(write_small(folder, "a.exr"));
    const std::string key("dataWindow\0box2i\0", 17);
    const std::size_t at = whole.find(key) + key.size() + 4;
    const auto with_window = [&](std::int32_t x0, std::int32_t y0, std::int32_t x1,
                                 std::int32_t y1) {
        std::string bad = whole;
        bad.replace(at, 16, testing::bytes(x0, y0, x1, y1));
        return folder.write("bad.exr", bad);
    };
    const auto refused = [](const std::string& path, const std::string& text) {
        expect_error(ErrorCode::BadFile, text, [&] { read(path); });
    };
    const std::int32_t most = std::numeric_limits<std::int32_t>::max();
    refused(with_window(0, 0, most, most), "2147483648 x 2147483648 px, the limit is 2^28 px");
    refused(with_window(-most, -most, most, most), "the limit is 2^28 px");
    refused(with_window(0, 0, 9999, 9999), "10000 x 10000 px, but has only");
    refused(with_window(5, 5, 4, 4), "0 x 0 px");
}

} // namespace
} // namespace heddle
