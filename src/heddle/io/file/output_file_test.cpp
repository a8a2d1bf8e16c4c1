#include <heddle/io/file/output_file.h>

#include <heddle/io/file/test_files.h>

#include <sys/stat.h>

namespace heddle {
namespace {

using testing::expect_error;
using testing::slurp;
using testing::TempFolder;

TEST(OutputFile, CommitPutsTheBytesInPlaceAndLeavesNothingElse) {
    const TempFolder folder;
    OutputFile file(folder.file("a.bin"));
    file.write("heddle", 6);
    file.write_value(std::uint16_t{0x0201});
    EXPECT_FALSE(std::filesystem::exists(folder.file("a.bin")));
    file.commit();
    EXPECT_EQ(slurp(folder.file("a.bin")), "heddle\x01\x02");
    EXPECT_EQ(folder.count_entries(), 1u);
}

TEST(OutputFile, WithoutCommitTheOldFileStays) {
    const TempFolder folder;
    const std::string path = folder.write("a.bin", "old");
    {
        OutputFile file(path);
        const std::string large(3u << 20, 'x'); // larger than the buffer: partly on disk
        file.write(large.data(), large.size());
    }
    EXPECT_EQ(slurp(path), "old");
    EXPECT_EQ(folder.count_entries(), 1u);
}

TEST(OutputFile, AnUnwindingErrorRemovesTheTemporaryFile) {
    const TempFolder folder;
    EXPECT_THROW(
        {
            OutputFile file(folder.file("a.bin"));
            file.write("x", 1);
            throw Error(ErrorCode::Cancelled, "cancelled");
        },
        Error);
    EXPECT_EQ(folder.count_entries(), 0u);
}

TEST(OutputFile, LargeWritesKeepTheirOrder) {
    const TempFolder folder;
    std::string expected;
    OutputFile file(folder.file("a.bin"));
    for (int i = 0; i < 300; ++i) {
        const std::string part(static_cast<std::size_t>(i * 61), static_cast<char>('a' + i % 26));
        file.write(part.data(), part.size());
        expected += part;
    }
    file.commit();
    EXPECT_GT(expected.size(), 2u << 20);
    EXPECT_EQ(slurp(folder.file("a.bin")), expected);
}

TEST(OutputFile, ALibraryMayWriteByTempPath) {
    const TempFolder folder;
    OutputFile file(folder.file("a.vdb"));
    EXPECT_EQ(std::filesystem::path(file.temp_path()).extension(), ".vdb");
    EXPECT_EQ(std::filesystem::path(file.temp_path()).parent_path(), folder.path());
    std::ofstream(file.temp_path()) << "by path";
    file.commit();
    EXPECT_EQ(slurp(folder.file("a.vdb")), "by path");
}

TEST(OutputFile, TwoForOnePlaceDoNotDisturbEachOther) {
    const TempFolder folder;
    OutputFile first(folder.file("a.bin"));
    OutputFile second(folder.file("a.bin"));
    EXPECT_NE(first.temp_path(), second.temp_path());
    first.write("first", 5);
    second.write("second", 6);
    second.commit();
    first.commit();
    EXPECT_EQ(slurp(folder.file("a.bin")), "first");
}

TEST(OutputFile, KeepsTheOldFilesModeAndTheLinkThatNamesIt) {
    const TempFolder folder;
    const std::string path = folder.write("real.bin", "old");
    ASSERT_EQ(::chmod(path.c_str(), 0640), 0);
    std::filesystem::create_symlink(path, folder.file("link.bin"));
    OutputFile file(folder.file("link.bin"));
    file.write("new", 3);
    file.commit();
    EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link.bin")));
    EXPECT_EQ(slurp(path), "new");
    struct stat info {};
    ASSERT_EQ(::stat(path.c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777u, 0640u);
}

TEST(OutputFile, MissingFolderDirectoryAndEmptyPathAreErrors) {
    const TempFolder folder;
    expect_error(ErrorCode::NotFound, "create its folder first",
                 [&] { OutputFile file(folder.file("no/a.bin")); });
    expect_error(ErrorCode::CannotWrite, "Is a directory; name a file, not a folder",
                 [&] { OutputFile file(folder.path()); });
    expect_error(ErrorCode::InvalidArgument, "empty", [] { OutputFile file(""); });
}

TEST(OutputFile, AFolderIsMadeWithThoseThatItIsIn) {
    const TempFolder folder;
    make_folder(folder.file("a/b"));
    make_folder(folder.file("a/b"));
    EXPECT_TRUE(std::filesystem::is_directory(folder.file("a/b")));
    const std::string path = folder.write("a.bin", "old");
    expect_error(ErrorCode::CannotWrite, "a.bin: this is a file, not a folder; name a folder",
                 [&] { make_folder(path); });
    expect_error(ErrorCode::CannotWrite, "cannot create this folder: Not a directory",
                 [&] { make_folder(path + "/b"); });
}

TEST(OutputFile, UnwritableFolderAndReadOnlyFileAreErrors) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
    const TempFolder folder;
    const std::string path = folder.write("a.bin", "old");
    ASSERT_EQ(::chmod(path.c_str(), 0444), 0);
    expect_error(ErrorCode::CannotWrite, "Permission denied", [&] { OutputFile file(path); });
    ASSERT_EQ(::chmod(folder.path().c_str(), 0555), 0);
    expect_error(ErrorCode::CannotWrite, "Permission denied",
                 [&] { OutputFile file(folder.file("b.bin")); });
    ASSERT_EQ(::chmod(folder.path().c_str(), 0755), 0);
}

TEST(OutputFile, FullDiskIsAnError) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    expect_error(ErrorCode::CannotWrite, "free some space", [] {
        OutputFile file("/dev/full");
        file.write("x", 1);
        file.commit();
    });
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(OutputFile, ADeviceIsWrittenInPlace) {
    OutputFile file("/dev/null");
    file.write("x", 1);
    file.commit();
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

} // namespace
} // namespace heddle
