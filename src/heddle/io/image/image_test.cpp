#include <heddle/io/image/image.h>

#include <heddle/base/error.h>
#include <heddle/io/image/file_bytes.h>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <csignal>
#include <fstream>
#include <functional>

namespace heddle {
namespace {

namespace fs = std::filesystem;

class Image : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) /
                  (std::string("heddle_image_") +
                   testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    fs::path folder_;
};

/// A pattern whose every texel and channel differs from its neighbours.
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

std::string message_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& e) {
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
        return e.what();
    }
    return "no error";
}

TEST_F(Image, PngReadsBackAsWrittenForEveryChannelCount) {
    for (int channels = 1; channels <= 4; ++channels) {
        const auto texels = pattern(13, 7, channels);
        write_png(folder_ / "a.png", 13, 7, channels, texels);
        const Texture read = read_image(folder_ / "a.png");
        EXPECT_EQ(read.width, 13);
        EXPECT_EQ(read.height, 7);
        EXPECT_EQ(read.channels, channels);
        EXPECT_FALSE(read.srgb);
        EXPECT_EQ(read.texels, texels);
    }
    EXPECT_FALSE(fs::exists(folder_ / "a.png.part"));
}

TEST_F(Image, SixteenBitsKeepTheirUpperByte) {
    // 1 x 1 px, 16-bit grey, value 0xABCD: signature, IHDR, IDAT (a stored block), IEND
    constexpr std::array<std::uint8_t, 71>
        kPng{
            0x89, 'P',  'N',  'G', 13,   10,   26,   10,   0,    0,    0, 13,
            'I',  'H',  'D',  'R', 0,    0,    0,    1,    0,    0,    0, 1,
            16,   0,    0,    0,   0,    0,    0,    0,    0, // the check sum: stb does not test it
            0,    0,    0,    14,  'I',  'D',  'A',  'T',  0x78, 0x01, 1, 3,
            0,    0xFC, 0xFF, 0,   0xAB, 0xCD, 0x02, 0x44, 0x01, 0x79, 0, 0,
            0,    0,    0,    0,   0,    0,    'I',  'E',  'N',  'D'};
    std::vector<std::uint8_t> png(kPng.begin(), kPng.end());
    png.resize(png.size() + 4);
    const Texture image = decode_image(std::as_bytes(std::span{png}), "deep");
    ASSERT_EQ(image.texels.size(), 1u);
    EXPECT_EQ(image.texels[0], 0xAB);
}

TEST_F(Image, EveryTruncationOfAPngIsAnErrorOrAWholeImage) {
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
    EXPECT_GT(errors, static_cast<int>(whole.size()) - 16); // at most IEND may be missing
}

TEST_F(Image, AHugeSizeInATinyFileIsRefusedBeforeAllocating) {
    std::vector<std::byte> bytes = png_bytes(9, 5, 1);
    bytes[18] = std::byte{0x3F}; // the width's third byte: 16 k
    bytes[21] = std::byte{0x3F}; // the height's second byte: 4 M
    EXPECT_NE(message_of([&] { (void)decode_image(bytes, "lie"); }).find("lie: "),
              std::string::npos);
}

TEST_F(Image, FoldersMissingFilesAndTextAreErrorsWithTheirPath) {
    std::ofstream(folder_ / "text.png") << "not an image";
    std::ofstream(folder_ / "empty.png");
    EXPECT_NE(message_of([&] { (void)read_image(folder_); }).find("is a folder"),
              std::string::npos);
    EXPECT_NE(message_of([&] { (void)read_image(folder_ / "no.png"); }).find("no such file"),
              std::string::npos);
    EXPECT_NE(message_of([&] { (void)read_image(folder_ / "text.png"); }).find("not a PNG"),
              std::string::npos);
    EXPECT_NE(message_of([&] { (void)read_image(folder_ / "empty.png"); }).find("is empty"),
              std::string::npos);
}

TEST_F(Image, WrongSizesAreRefused) {
    const auto texels = pattern(4, 4, 3);
    EXPECT_THROW((void)encode_png(4, 4, 4, texels), Error);
    EXPECT_THROW((void)encode_png(0, 4, 3, {}), Error);
    EXPECT_THROW((void)encode_png(4, 4, 5, texels), Error);
    EXPECT_THROW((void)encode_png(1 << 20, 1 << 20, 4, texels), Error);
}

TEST_F(Image, AMissingFolderIsAnErrorWithTheOutputsPath) {
    const std::string text =
        message_of([&] { write_png(folder_ / "no" / "a.png", 1, 1, 1, pattern(1, 1, 1)); });
    EXPECT_NE(text.find("a.png: cannot be written"), std::string::npos) << text;
}

TEST_F(Image, AFullDiskLeavesTheOldFileUntouched) {
    const fs::path path = folder_ / "a.png";
    write_png(path, 2, 2, 1, pattern(2, 2, 1));
    const auto before = read_bytes(path);
    rlimit old{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN); // a write past the limit then says EFBIG
    const rlimit small{.rlim_cur = 256, .rlim_max = old.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const std::string text =
        message_of([&] { write_png(path, 256, 256, 3, pattern(256, 256, 3)); });
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);
    std::signal(SIGXFSZ, handler);
    EXPECT_NE(text.find("could not be written"), std::string::npos) << text;
    EXPECT_EQ(read_bytes(path), before);
    EXPECT_FALSE(fs::exists(folder_ / "a.png.part"));
}

} // namespace
} // namespace heddle
