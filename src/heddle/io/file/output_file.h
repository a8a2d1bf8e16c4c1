#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace heddle {

/// A file that appears at its path completely or not at all.
///
/// Bytes are written to a temporary file in the same folder (a hidden name, the same suffix);
/// `commit()` renames it. If it is destroyed without commit (an Error, or Error{Cancelled} after
/// Ctrl-C), the temporary file is removed and the old file unchanged. A device or pipe
/// (/dev/stdout) is written directly; a symbolic link keeps its target. Either use `write`, or give
/// `temp_path()` to a library that writes by path: not both.
class OutputFile {
public:
    /// Opens the temporary file.
    /// @throws Error  NotFound: no such folder; CannotWrite: a directory, a read-only file or
    /// folder
    explicit OutputFile(std::string path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }
    /// Where the bytes are until commit: it exists, is empty, and has the final path's suffix.
    [[nodiscard]] const std::string& temp_path() const { return temp_path_; }

    /// Appends bytes.
    /// @throws Error  CannotWrite: full disk, failing disk
    void write(const void* data, std::size_t bytes);
    template <typename T>
    void write_array(std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        write(values.data(), values.size_bytes());
    }
    /// Appends one number, little-endian.
    template <typename T>
    void write_value(T value) {
        static_assert(std::is_arithmetic_v<T>);
        write(&value, sizeof(T));
    }

    /// Throws the Error of a failed write, for code that writes to `temp_path()`.
    /// @param doing  "write", in "cannot write"
    /// @param error  an errno
    [[noreturn]] void fail(const char* doing, int error) const;

    /// Flushes, waits until the disk has the bytes, and renames the file. Call it once, at the end.
    /// @throws Error  CannotWrite; the old file is then unchanged
    void commit();

private:
    void flush();
    void close_checked();

    std::string path_;       ///< as the user named it, for messages
    std::string final_path_; ///< with a symbolic link resolved
    std::string temp_path_;
    std::vector<char> buffer_;
    int fd_ = -1;
    bool in_place_ = false; ///< a device or pipe: no temporary file, nothing to rename
    bool pending_ = false;  ///< the temporary file exists and must be removed
};

/// Creates a folder and those that it is in. A folder that exists stays as it is.
/// @throws Error  CannotWrite: it is a file, or permission is missing
void make_folder(const std::string& path);

} // namespace heddle
