#include <heddle/base/temp_file.h>

#include <heddle/base/error.h>

#include <unistd.h>
#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace heddle {

TempFile::TempFile(const std::string& folder) : folder_(folder) {
    std::string name = folder + "/.heddle-XXXXXX";
    file_ = mkstemp(name.data());
    if (file_ < 0) {
        throw Error(ErrorCode::InvalidArgument,
                    str("cannot make a temporary file: ", std::strerror(errno)),
                    "choose a writable folder, or raise --memory", {.path = folder});
    }
    unlink(name.c_str());
}

TempFile::~TempFile() {
    close(file_);
}

std::int64_t TempFile::append(const void* data, std::size_t bytes) {
    const std::int64_t at = size_;
    const char* from = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t wrote = pwrite(file_, from, bytes, size_);
        if (wrote < 0 && errno == EINTR) continue;
        if (wrote <= 0) {
            throw Error(
                ErrorCode::OutOfMemory,
                str("the temporary file stops at ", size_, " bytes: ", std::strerror(errno)),
                "free disk space there, or raise --memory", {.path = folder_});
        }
        from += wrote;
        bytes -= static_cast<std::size_t>(wrote);
        size_ += wrote;
    }
    return at;
}

void TempFile::read(std::int64_t offset, void* data, std::size_t bytes) const {
    char* to = static_cast<char*>(data);
    while (bytes > 0) {
        const ssize_t got = pread(file_, to, bytes, offset);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) {
            throw Error(ErrorCode::Internal, str("temporary file: no byte at ", offset), "",
                        {.path = folder_});
        }
        to += got;
        bytes -= static_cast<std::size_t>(got);
        offset += got;
    }
}

} // namespace heddle
