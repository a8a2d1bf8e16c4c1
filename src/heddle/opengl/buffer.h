#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace heddle::opengl {

/// A buffer in the driver's memory that shaders read and write. Needs a current Context while it
/// lives.
class Buffer {
public:
    /// @param name  its contents, for messages
    /// @throws Error  OutOfMemory
    Buffer(const char* name, std::size_t bytes);
    template <typename T>
    Buffer(const char* name, std::span<const T> values) : Buffer(name, std::as_bytes(values)) {}
    Buffer(const char* name, std::span<const std::byte> bytes);
    ~Buffer();
    Buffer(Buffer&& other) noexcept : id_(other.id_), bytes_(other.bytes_) { other.id_ = 0; }
    Buffer& operator=(Buffer&& other) noexcept;
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;

    /// Binds it as shader storage block `binding`.
    void bind_storage(std::uint32_t binding) const;
    /// Binds it as uniform block `binding`.
    void bind_uniform(std::uint32_t binding) const;
    /// Binds it as the source of indirect draws and dispatches.
    void bind_indirect() const;
    /// Sets all its 32-bit words.
    void clear(std::uint32_t word = 0) const;
    void write(std::span<const std::byte> bytes, std::size_t offset = 0) const;
    /// Reads it after the shaders before have finished.
    void read(std::span<std::byte> out, std::size_t offset = 0) const;
    [[nodiscard]] std::size_t byte_count() const { return bytes_; }

private:
    std::uint32_t id_ = 0;
    std::size_t bytes_ = 0;
};

} // namespace heddle::opengl
