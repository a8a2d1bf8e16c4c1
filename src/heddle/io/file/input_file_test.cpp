#include <heddle/io/file/input_file.h>

#include <heddle/io/file/test_files.h>

#include <sys/stat.h>

namespace heddle {
namespace {

using testing::bytes;
using testing::expect_error;
using testing::TempFolder;

TEST(ByteReader, ReadsEachTypeLittleEndian) {
    const TempFolder folder;
    ByteReader file(
        folder.write("a", bytes(std::uint8_t{7}, -5, std::uint64_t{1} << 40, 2.5f) + "text"));
    EXPECT_EQ(file.u8("a"), 7);
    EXPECT_EQ(file.i32("c"), -5);
    EXPECT_EQ(file.u64("d"), std::uint64_t{1} << 40);
    EXPECT_EQ(file.f32("e"), 2.5f);
    EXPECT_EQ(file.text(4, "f"), "text");
    EXPECT_EQ(file.remaining(), 0u);
}

TEST(ByteReader, SmallAndLargeReadsAcrossTheBufferAgree) {
    std::vector<std::uint32_t> number(100000);
    for (std::size_t i = 0; i < number.size(); ++i) number[i] = static_cast<std::uint32_t>(i * 7);
    const TempFolder folder;
    const std::string path = folder.file("a");
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(number.data()), 4 * 100000);
    ByteReader file(path);
    std::size_t at = 0;
    for (const std::size_t n : {1u, 3u, 20000u, 1u, 0u, 17000u, 2u, 30000u, 5u}) {
        const std::vector<std::uint32_t> part = file.array<std::uint32_t>(n, "numbers");
        for (const std::uint32_t x : part) ASSERT_EQ(x, number[at++]);
    }
    file.skip(10, 4, "numbers");
    at += 10;
    EXPECT_EQ(file.u32("number"), number[at]);
}

TEST(ByteReader, PastTheEndIsAnErrorThatNamesByteAndNeed) {
    const TempFolder folder;
    ByteReader file(folder.write("a.bcc", "123456"));
    EXPECT_EQ(file.u8("start"), '1');
    expect_error(ErrorCode::BadFile, "a.bcc: byte 1: 'curve count' needs 8 bytes, 5 are left",
                 [&] { static_cast<void>(file.u64("curve count")); });
    EXPECT_EQ(file.offset(), 1u);
}

TEST(ByteReader, CountsBeyondTheFileTakeNoMemory) {
    const TempFolder folder;
    ByteReader file(folder.write("a", "123456"));
    for (const std::uint64_t count : {std::uint64_t{2}, ~std::uint64_t{0}, ~std::uint64_t{0} / 4}) {
        expect_error(ErrorCode::BadFile, "are left",
                     [&] { static_cast<void>(file.array<float>(count, "floats")); });
    }
    EXPECT_EQ(file.array<float>(1, "floats").size(), 1u);
}

TEST(ByteReader, AFileThatShrinksWhileReadIsAnError) {
    const TempFolder folder;
    const std::string path = folder.write("a", std::string(1u << 20, 'x'));
    ByteReader file(path);
    EXPECT_EQ(file.u8("first"), 'x');
    std::filesystem::resize_file(path, 100);
    expect_error(ErrorCode::BadFile, "the file ends here",
                 [&] { static_cast<void>(file.array<char>((1u << 20) - 1, "rest")); });
}

TEST(InputFile, WhatIsNoFileIsAClearError) {
    const TempFolder folder;
    expect_error(ErrorCode::NotFound, "no such file", [&] { InputFile f(folder.file("none")); });
    expect_error(ErrorCode::NotFound, "no such file",
                 [&] { InputFile f(folder.write("a", "x") + "/below"); });
    expect_error(ErrorCode::BadFile, "is a directory", [&] { InputFile f(folder.path()); });
    expect_error(ErrorCode::BadFile, "device or pipe", [] { InputFile f("/dev/null"); });
    ASSERT_EQ(::mkfifo(folder.file("pipe").c_str(), 0600), 0);
    expect_error(ErrorCode::BadFile, "device or pipe", [&] { InputFile f(folder.file("pipe")); });
}

TEST(InputFile, AnUnreadableFileIsAClearError) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
    const TempFolder folder;
    const std::string path = folder.write("a", "x");
    ASSERT_EQ(::chmod(path.c_str(), 0), 0);
    expect_error(ErrorCode::BadFile, "Permission denied", [&] { InputFile f(path); });
}

TEST(InputFile, WholeFileComesBackUpToTheLimit) {
    const TempFolder folder;
    const std::string path = folder.write("a", std::string("a\0b", 3));
    EXPECT_EQ(read_whole_file(path), std::string("a\0b", 3));
    EXPECT_EQ(read_whole_file(folder.write("empty", "")), "");
    expect_error(ErrorCode::BadFile, "has 3 bytes, the limit for this kind is 2",
                 [&] { static_cast<void>(read_whole_file(path, 2)); });
}

} // namespace
} // namespace heddle
