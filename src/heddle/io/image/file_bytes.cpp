#include <heddle/io/image/file_bytes.h>

#include <heddle/base/error.h>
#include <heddle/base/memory.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace heddle {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kAlwaysFits =
    1 << 26; // asking the system costs more than reading a small file

struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

[[noreturn]] void fail(const fs::path& path, const std::string& what, const std::string& fix) {
    throw Error(ErrorCode::BadFile, what, fix, {.path = path.string()});
}

bool write_parts(std::FILE* file, std::span<const std::span<const std::byte>> parts) {
    for (const auto part : parts) {
        if (!part.empty() && std::fwrite(part.data(), 1, part.size(), file) != part.size())
            return false;
    }
    return std::fflush(file) == 0;
}

} // namespace

std::vector<std::byte> read_bytes(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found)
        throw Error(ErrorCode::NotFound, "there is no such file", "check the name",
                    {.path = path.string()});
    if (status.type() == fs::file_type::directory)
        fail(path, "is a folder, not a file", "name a file in it");
    if (status.type() != fs::file_type::regular)
        fail(path, "is not a regular file", "name a file on disk");
    const File file{std::fopen(path.c_str(), "rb")};
    if (!file) fail(path, str("cannot be opened: ", std::strerror(errno)), "check its permissions");
    const std::uintmax_t size = fs::file_size(path, error);
    if (error) fail(path, str("has no size: ", error.message()), "check the disk");
    const std::int64_t free_bytes = size < kAlwaysFits ? 0 : available_bytes();
    if (free_bytes > 0 && size > static_cast<std::uintmax_t>(free_bytes))
        throw Error(ErrorCode::OutOfMemory,
                    str("holds ", size, " bytes, and ", free_bytes, " bytes of memory are free"),
                    "free some memory or split the file", {.path = path.string()});
    std::vector<std::byte> bytes(size);
    if (size > 0 && std::fread(bytes.data(), 1, size, file.get()) != size)
        fail(path, str("ended before its ", size, " bytes were read"), "check the disk");
    return bytes;
}

void replace_file(const fs::path& path, std::span<const std::span<const std::byte>> parts) {
    if (std::error_code error; fs::is_directory(path, error))
        fail(path, "is a folder and cannot be written as a file", "name a file in it");
    fs::path beside = path;
    beside += ".part";
    File file{std::fopen(beside.c_str(), "wb")};
    if (!file)
        fail(path, str("cannot be written: ", std::strerror(errno)),
             "check that its folder exists and may be written");
    bool written = write_parts(file.get(), parts);
    int reason = errno;
    if (std::fclose(file.release()) != 0 && written) {
        written = false;
        reason = errno;
    }
    std::error_code error;
    if (written) {
        fs::rename(beside, path, error);
        if (!error) return;
        reason = error.value();
    }
    fs::remove(beside, error);
    fail(path, str("could not be written: ", std::strerror(reason)),
         "free some space or choose another folder");
}

} // namespace heddle
