#include <heddle/io/image/image.h>

#include <heddle/base/error.h>
#include <heddle/io/file/test_files.h>

#include <gtest/gtest.h>

#include <array>

namespace heddle {
namespace {

using testing::expect_error;
using testing::TempFolder;

/// A pattern in which every texel and channel differs from its neighbours.
std::vector<std::uint8_t> pattern(int width, int height, int channels) {
    std::vector<std::uint8_t> texels(static_cast<std::size_t>(width * height * channels));
    for (std::size_t i = 0; i < texels.size(); ++i)
        texels[i] = static_cast<std::uint8_t>(i * 37 + i / 11);
    return texels;
}

std::vector<std::byte> png_bytes(int width, int height, int channels) {
    const auto png = encode_png(width, height, channels, pattern(width, height, channels));
    const auto bytes = std::as_bytes(std::span{png});
    return {bytes.begin(), bytes.end()};
}

TEST(Image, PngReadsBackAsWrittenForEveryChannelCount) {
    const TempFolder folder;
    const std::string path = folder.file("a.png");
    for (int channels = 1; channels <= 4; ++channels) {
        const auto texels = pattern(13, 7, channels);
        write_png(path, 13, 7, channels, texels);
        const Texture read = read_image(path);
        EXPECT_EQ(read.width, 13);
        EXPECT_EQ(read.height, 7);
        EXPECT_EQ(read.channels, channels);
        EXPECT_FALSE(read.srgb);
        EXPECT_EQ(read.texels, texels);
    }
    EXPECT_EQ(folder.count_entries(), 1u);
}

TEST(Image, SixteenBitsKeepTheirUpperByte) {
    // 1 x 1 px, 16-bit grey, value 0xABCD: signature, IHDR, IDAT (a stored block), IEND
    constexpr std::array<std::uint8_t, 71>
        kPng{
            0x89, 'P',  'N',  'G', 13,   10,   26,   10,   0,    0,    0, 13,
            'I',  'H',  'D',  'R', 0,    0,    0,    1,    0,    0,    0, 1,
            16,   0,    0,    0,   0,    0,    0,    0,    0, // the checksum: stb does not check it
            0,    0,    0,    14,  'I',  'D',  'A',  'T',  0x78, 0x01, 1, 3,
            0,    0xFC, 0xFF, 0,   0xAB, 0xCD, 0x02, 0x44, 0x01, 0x79, 0, 0,
            0,    0,    0,    0,   0,    0,    'I',  'E',  'N',  'D'};
    std::vector<std::uint8_t> png(kPng.begin(), kPng.end());
    png.resize(png.size() + 4);
    const Texture image = decode_image(std::as_bytes(std::span{png}), "deep");
    ASSERT_EQ(image.texels.size(), 1u);
    EXPECT_EQ(image.texels[0], 0xAB);
}

TEST(Image, EveryTruncationOfAPngIsAnErrorOrAWholeImage) {
    const std::vector<std::byte> whole = png_bytes(9, 5, 3);
    int errors = 0;
    for (std::size_t n = 0; n < whole.size(); ++n) {
        const std::vector<std::byte> part(whole.begin(), whole.begin() + static_cast<long>(n));
        try {
            EXPECT_EQ(decode_image(part, "part").texels.size(), 9u * 5u * 3u);
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::BadFile);
            ++errors;
        }
    }
    EXPECT_GT(errors, static_cast<int>(whole.size()) - 16); // only IEND may be missing
}

TEST(Image, AHugeSizeInATinyFileIsRefusedBeforeAllocating) {
    std::vector<std::byte> bytes = png_bytes(9, 5, 1);
    bytes[18] = std::byte{0x3F}; // third byte of the width: 16 k
    bytes[21] = std::byte{0x3F}; // second byte of the height: 4 M
    expect_error(ErrorCode::BadFile, "lie: ", [&] { (void)decode_image(bytes, "lie"); });
}

TEST(Image, FoldersMissingFilesAndTextAreErrors) {
    const TempFolder folder;
    const std::string text = folder.write("text.png", "not an image");
    const std::string empty = folder.write("empty.png", "");
    const auto read = [](const std::string& path) { return [path] { (void)read_image(path); }; };
    expect_error(ErrorCode::BadFile, "is a directory", read(folder.path()));
    expect_error(ErrorCode::NotFound, "no such file", read(folder.file("no.png")));
    expect_error(ErrorCode::BadFile, "not a PNG", read(text));
    expect_error(ErrorCode::BadFile, "is empty", read(empty));
}

TEST(Image, WrongSizesAreRefused) {
    const auto texels = pattern(4, 4, 3);
    EXPECT_THROW((void)encode_png(4, 4, 4, texels), Error);
    EXPECT_THROW((void)encode_png(0, 4, 3, {}), Error);
    EXPECT_THROW((void)encode_png(4, 4, 5, texels), Error);
    EXPECT_THROW((void)encode_png(1 << 20, 1 << 20, 4, texels), Error);
}

TEST(Image, AMissingFolderAndAFullDiskAreErrorsWithTheOutputsPath) {
    const TempFolder folder;
    const auto write = [](const std::string& path) {
        return [path] { write_png(path, 1, 1, 1, pattern(1, 1, 1)); };
    };
    expect_error(ErrorCode::NotFound, "a.png: cannot", write(folder.file("no/a.png")));
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    expect_error(ErrorCode::CannotWrite, "/dev/full: cannot", write("/dev/full"));
}

} // namespace
} // namespace heddle
