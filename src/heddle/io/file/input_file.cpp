#include <heddle/io/file/input_file.h>

#include <heddle/base/error.h>
#include <heddle/base/memory.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

namespace heddle {
namespace {

constexpr std::uint64_t kBufferBytes = 1u << 16; // small reads are served from this buffer
constexpr std::uint64_t kSurelyFits = 1u << 26;
constexpr const char* kCutShort =
    "the file is cut short or of another kind; copy or export it again";

[[noreturn]] void fail_open(const std::string& path, int error) {
    const bool missing = error == ENOENT || error == ENOTDIR;
    throw Error(missing ? ErrorCode::NotFound : ErrorCode::BadFile,
                missing ? "no such file" : str("cannot be read: ", std::strerror(error)),
                missing ? "check the path" : "check its permissions", {.path = path});
}

} // namespace

std::string suffix_of(const std::string& path) {
    std::string suffix = std::filesystem::path(path).extension().string();
    for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return suffix;
}

InputFile::InputFile(std::string path) : path_(std::move(path)) {
    // O_NONBLOCK: opening a pipe that has no writer must not block before its type is checked
    fd_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (fd_ < 0) fail_open(path_, errno);
    struct stat info {};
    const char* trouble = nullptr;
    if (::fstat(fd_, &info) != 0) trouble = "its size cannot be read";
    if (S_ISDIR(info.st_mode))
        trouble = "is a directory, not a file";
    else if (!S_ISREG(info.st_mode))
        trouble = "is a device or pipe, not a file";
    if (trouble != nullptr) {
        ::close(fd_);
        throw Error(ErrorCode::BadFile, trouble, "name a regular file", {.path = path_});
    }
    size_bytes_ = static_cast<std::uint64_t>(info.st_size);
}

InputFile::~InputFile() {
    ::close(fd_);
}

void InputFile::read_at(std::uint64_t offset, void* out, std::uint64_t bytes) const {
    char* to = static_cast<char*>(out);
    while (bytes > 0) {
        const std::uint64_t ask = std::min<std::uint64_t>(bytes, 1u << 30); // Linux reads <= 2 GiB
        const ssize_t got = ::pread(fd_, to, ask, static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) {
            throw Error(ErrorCode::BadFile,
                        got < 0 ? str("cannot be read: ", std::strerror(errno))
                                : str("the file ends here, ", bytes, " bytes early"),
                        kCutShort, {.path = path_, .offset = static_cast<std::int64_t>(offset)});
        }
        to += got;
        offset += static_cast<std::uint64_t>(got);
        bytes -= static_cast<std::uint64_t>(got);
    }
}

std::string read_whole_file(const std::string& path, std::uint64_t limit_bytes) {
    const InputFile file(path);
    if (file.size_bytes() > limit_bytes) {
        throw Error(
            ErrorCode::BadFile,
            str("has ", file.size_bytes(), " bytes, the limit for this kind is ", limit_bytes),
            "check that it is the right file", {.path = path});
    }
    // the query costs more than reading a small file
    const std::int64_t available = file.size_bytes() < kSurelyFits ? 0 : available_bytes();
    if (available > 0 && file.size_bytes() > static_cast<std::uint64_t>(available)) {
        throw Error(
            ErrorCode::OutOfMemory,
            str("has ", file.size_bytes(), " bytes, and ", available, " bytes of memory are free"),
            "free some memory or split the file", {.path = path});
    }
    std::string text(file.size_bytes(), '\0');
    file.read_at(0, text.data(), text.size());
    return text;
}

ByteReader::ByteReader(std::string path) : file_(std::move(path)) {}

std::string ByteReader::text(std::uint64_t bytes, const char* what) {
    require(bytes, 1, what);
    std::string out(bytes, '\0');
    read(out.data(), bytes, what);
    return out;
}

void ByteReader::skip(std::uint64_t count, std::uint64_t bytes_each, const char* what) {
    require(count, bytes_each, what);
    offset_ += count * bytes_each;
}

void ByteReader::require(std::uint64_t count, std::uint64_t bytes_each, const char* what) const {
    if (count <= remaining() / bytes_each) return; // divided: the product may overflow 64 bits
    fail(offset_,
         count == 1 ? str("'", what, "' needs ", bytes_each, " bytes, ", remaining(), " are left")
                    : str("'", what, "' needs ", count, " x ", bytes_each, " bytes, ", remaining(),
                          " are left"),
         kCutShort);
}

void ByteReader::fail(std::uint64_t at, const std::string& what, const std::string& fix) const {
    throw Error(ErrorCode::BadFile, what, fix,
                {.path = path(), .offset = static_cast<std::int64_t>(at)});
}

void ByteReader::read(void* out, std::uint64_t bytes, const char* what) {
    if (bytes == 0) return;
    require(1, bytes, what);
    char* to = static_cast<char*>(out);
    const std::uint64_t buffer_end = buffer_start_ + buffer_.size();
    if (offset_ >= buffer_start_ && offset_ < buffer_end) { // the part of it in the buffer
        const std::uint64_t have = std::min(bytes, buffer_end - offset_);
        std::memcpy(to, buffer_.data() + (offset_ - buffer_start_), have);
        to += have;
        offset_ += have;
        bytes -= have;
    }
    if (bytes == 0) return;
    if (bytes >= kBufferBytes) {
        file_.read_at(offset_, to, bytes);
    } else {
        buffer_.resize(std::min(kBufferBytes, remaining()));
        buffer_start_ = offset_;
        file_.read_at(offset_, buffer_.data(), buffer_.size());
        std::memcpy(to, buffer_.data(), bytes);
    }
    offset_ += bytes;
}

} // namespace heddle
