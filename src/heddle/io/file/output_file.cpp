#include <heddle/io/file/output_file.h>

#include <heddle/base/error.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

namespace heddle {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBufferBytes = 1u << 20;

/// "dir/.name.heddle-PID-N.suffix": hidden, unique on this machine, and with the suffix, by which
/// some libraries choose a format.
std::string make_temp_name(const fs::path& final_path) {
    static std::atomic<unsigned> count{0};
    const std::string name = str(".", final_path.stem().string(), ".heddle-", ::getpid(), "-",
                                 count.fetch_add(1), final_path.extension().string());
    return (final_path.parent_path() / name).string();
}

/// Waits until the file or folder at `path` is on the disk; returns 0 or errno.
int sync_path(const std::string& path) {
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) return errno;
    const int error = ::fsync(fd) != 0 ? errno : 0;
    ::close(fd);
    return error;
}

/// Returns what the user can do about an errno.
const char* fix_of(int error) {
    switch (error) {
    case ENOENT:
    case ENOTDIR: return "create its folder first";
    case EISDIR: return "name a file, not a folder";
    case EACCES:
    case EPERM:
    case EROFS: return "choose a file in a folder that you may write to";
    case ENOSPC:
    case EDQUOT: return "free some space, or choose a file on another disk";
    case ELOOP: return "name the file itself, not this link";
    case ENAMETOOLONG: return "choose a shorter name";
    default: return "choose another file, on another disk if this one fails";
    }
}

} // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)), final_path_(path_) {
    if (path_.empty()) {
        throw Error(ErrorCode::InvalidArgument, "the output path is empty", "name a file");
    }
    std::error_code ignored;
    if (fs::is_symlink(path_, ignored)) {
        final_path_ = fs::weakly_canonical(path_, ignored).string();
        if (final_path_.empty()) fail("follow the link", ELOOP);
    }
    struct stat old {};
    const bool exists = ::stat(final_path_.c_str(), &old) == 0;
    if (exists && S_ISDIR(old.st_mode)) fail("write", EISDIR);
    if (exists && ::access(final_path_.c_str(), W_OK) != 0) fail("replace", errno);
    in_place_ = exists && !S_ISREG(old.st_mode);
    if (in_place_) {
        temp_path_ = final_path_;
        fd_ = ::open(temp_path_.c_str(), O_WRONLY | O_CLOEXEC);
    } else {
        const mode_t mode = exists ? old.st_mode & 0777 : 0666; // else minus the umask
        for (int attempt = 0; attempt < 100; ++attempt) {       // a crashed run may have left one
            temp_path_ = make_temp_name(final_path_);
            fd_ = ::open(temp_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
            if (fd_ >= 0 || errno != EEXIST) break;
        }
        pending_ = fd_ >= 0;
        if (exists && pending_) static_cast<void>(::fchmod(fd_, mode)); // undoes the umask
    }
    if (fd_ < 0) fail("open for writing", errno);
}

OutputFile::~OutputFile() {
    if (fd_ >= 0) ::close(fd_);
    if (pending_) ::unlink(temp_path_.c_str());
}

void OutputFile::fail(const char* doing, int error) const {
    const bool no_folder = error == ENOENT || error == ENOTDIR;
    throw Error(no_folder ? ErrorCode::NotFound : ErrorCode::CannotWrite,
                str("cannot ", doing, ": ", std::strerror(error)), fix_of(error), {.path = path_});
}

void OutputFile::write(const void* data, std::size_t bytes) {
    const char* from = static_cast<const char*>(data);
    buffer_.reserve(kBufferBytes);
    while (bytes > 0) {
        const std::size_t part = std::min(bytes, kBufferBytes - buffer_.size());
        buffer_.insert(buffer_.end(), from, from + part);
        from += part;
        bytes -= part;
        if (buffer_.size() == kBufferBytes) flush();
    }
}

void OutputFile::flush() {
    std::size_t done = 0;
    while (done < buffer_.size()) {
        const ssize_t n = ::write(fd_, buffer_.data() + done, buffer_.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) fail("write", n < 0 ? errno : ENOSPC);
        done += static_cast<std::size_t>(n);
    }
    buffer_.clear();
}

void OutputFile::close_checked() {
    // a network disk may report only here, in close(), that it is full
    if (::close(std::exchange(fd_, -1)) != 0 && errno != EINTR) fail("write", errno);
}

void OutputFile::commit() {
    flush();
    close_checked();
    if (in_place_) return;
    // by path: a library that wrote by path may have replaced the file
    if (const int error = sync_path(temp_path_); error != 0) fail("write", error);
    if (::rename(temp_path_.c_str(), final_path_.c_str()) != 0) fail("put in place", errno);
    pending_ = false;
    // the bytes are safe: a folder that cannot be synced is no reason to fail
    const fs::path folder = fs::path(final_path_).parent_path();
    static_cast<void>(sync_path(folder.empty() ? "." : folder.string()));
}

void make_folder(const std::string& path) {
    std::error_code error;
    fs::create_directories(path, error);
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) return;
    if (fs::exists(path, ignored)) {
        throw Error(ErrorCode::CannotWrite, "this is a file, not a folder", "name a folder",
                    {.path = path});
    }
    throw Error(ErrorCode::CannotWrite, str("cannot create this folder: ", error.message()),
                "choose a folder that you may create", {.path = path});
}

} // namespace heddle
