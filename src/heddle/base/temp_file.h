#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace heddle {

/// A nameless file that disappears with the process. One thread at a time appends; any reads.
class TempFile {
public:
    /// @param folder  where the file is created
    /// @throws Error  InvalidArgument: the folder cannot be written
    explicit TempFile(const std::string& folder);
    ~TempFile();
    TempFile(const TempFile&) = delete;
    TempFile& operator=(const TempFile&) = delete;
    TempFile(TempFile&&) = delete;
    TempFile& operator=(TempFile&&) = delete;

    /// Appends `bytes` bytes. @return the offset of the first one
    /// @throws Error  OutOfMemory: the disk is full
    std::int64_t append(const void* data, std::size_t bytes);
    /// @throws Error  Internal: the file has fewer bytes than asked for
    void read(std::int64_t offset, void* data, std::size_t bytes) const;

private:
    std::string folder_;
    int file_ = -1;
    std::int64_t size_ = 0;
};

} // namespace heddle
