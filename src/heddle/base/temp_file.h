#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace heddle {

/// A nameless file that is gone with the process. Append from one thread at a time; read from any.
class TempFile {
public:
    /// @param folder  where its bytes lie
    /// @throws Error  InvalidArgument: the folder cannot be written
    explicit TempFile(const std::string& folder);
    ~TempFile();
    TempFile(const TempFile&) = delete;
    TempFile& operator=(const TempFile&) = delete;
    TempFile(TempFile&&) = delete;
    TempFile& operator=(TempFile&&) = delete;

    /// Writes at the end. @return the offset of the first byte
    /// @throws Error  OutOfMemory: the disk is full
    std::int64_t append(const void* data, std::size_t bytes);
    /// @throws Error  Internal: fewer bytes there than asked for
    void read(std::int64_t offset, void* data, std::size_t bytes) const;

private:
    std::string folder_;
    int file_ = -1;
    std::int64_t size_ = 0;
};

} // namespace heddle
