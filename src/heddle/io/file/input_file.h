#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace heddle {

/// The suffix of a path in lower case, with its dot: ".bcc"; empty if there is none.
[[nodiscard]] std::string suffix_of(const std::string& path);

/// A regular file that is open for reading. Its size is read once, when it is opened.
///
/// It is read by offset, not mapped: if it shrinks while it is read, that is an Error, not a
/// SIGBUS. Threads: `read_at` may be called from several.
class InputFile {
public:
    /// @throws Error  NotFound: no such file; BadFile: a directory, a device or pipe, not readable
    explicit InputFile(std::string path);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] std::uint64_t size_bytes() const { return size_bytes_; }

    /// Fills `out` with `bytes` bytes from `offset` on.
    /// @throws Error  BadFile: the file is too short, or the disk fails
    void read_at(std::uint64_t offset, void* out, std::uint64_t bytes) const;

private:
    std::string path_;
    std::uint64_t size_bytes_ = 0;
    int fd_ = -1;
};

/// The limit for kinds of files that have none.
inline constexpr std::uint64_t kAnySize = ~std::uint64_t{0};

/// Reads the whole file, for parsers of text.
/// @param limit_bytes  largest size allowed; a larger file is likely a wrong one, and an Error
/// @throws Error       as InputFile; BadFile: larger than the limit; OutOfMemory: than free memory
[[nodiscard]] std::string read_whole_file(const std::string& path,
                                          std::uint64_t limit_bytes = std::uint64_t{1} << 30);

/// Reads a little-endian binary file from front to back, never past its end.
///
/// Every read names what it reads, for messages. Arrays are read into their final memory, without a
/// second copy of the file. All reads throw Error{BadFile} with path and byte offset.
class ByteReader {
public:
    explicit ByteReader(std::string path);

    [[nodiscard]] const std::string& path() const { return file_.path(); }
    [[nodiscard]] std::uint64_t size_bytes() const { return file_.size_bytes(); }
    [[nodiscard]] std::uint64_t offset() const { return offset_; }
    [[nodiscard]] std::uint64_t remaining() const { return size_bytes() - offset_; }

    [[nodiscard]] std::uint8_t u8(const char* what) { return value<std::uint8_t>(what); }
    [[nodiscard]] std::uint32_t u32(const char* what) { return value<std::uint32_t>(what); }
    [[nodiscard]] std::int32_t i32(const char* what) { return value<std::int32_t>(what); }
    [[nodiscard]] std::uint64_t u64(const char* what) { return value<std::uint64_t>(what); }
    [[nodiscard]] float f32(const char* what) { return value<float>(what); }
    /// Reads `bytes` bytes unchanged.
    [[nodiscard]] std::string text(std::uint64_t bytes, const char* what);

    /// Fills `out` from the file.
    template <typename T>
    void fill(std::span<T> out, const char* what) {
        static_assert(std::is_trivially_copyable_v<T>);
        read(out.data(), out.size_bytes(), what);
    }
    /// Reads the next `count` values; the file's size is checked before memory is allocated.
    template <typename T>
    [[nodiscard]] std::vector<T> array(std::uint64_t count, const char* what) {
        require(count, sizeof(T), what);
        std::vector<T> out(count);
        fill(std::span<T>(out), what);
        return out;
    }
    /// Skips `count` items of `bytes_each` bytes.
    void skip(std::uint64_t count, std::uint64_t bytes_each, const char* what);

    /// @throws Error  BadFile: `count` items of `bytes_each` (>= 1) bytes are more than remain
    void require(std::uint64_t count, std::uint64_t bytes_each, const char* what) const;

    /// Throws Error{BadFile} at byte `at`.
    [[noreturn]] void
    fail(std::uint64_t at, const std::string& what, const std::string& fix = {}) const;

private:
    template <typename T>
    [[nodiscard]] T value(const char* what) {
        T v{};
        read(&v, sizeof(T), what);
        return v;
    }
    void read(void* out, std::uint64_t bytes, const char* what);

    InputFile file_;
    std::uint64_t offset_ = 0;
    std::vector<char> buffer_; ///< bytes [buffer_start_, buffer_start_ + buffer_.size())
    std::uint64_t buffer_start_ = 0;

    static_assert(std::endian::native == std::endian::little, "files are read without swapping");
};

} // namespace heddle
