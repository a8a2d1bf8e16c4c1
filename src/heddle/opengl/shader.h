#pragma once

#include <heddle/base/vec.h>

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace heddle::opengl {

/// A linked program. Needs a current Context while it lives.
class Program {
public:
    /// A compute shader in groups of 64. Before the source, which may come in two parts, stand
    /// `#version 450 core`, the group's size and `uint item()`, the number of the invocation's
    /// item; it may be past the last.
    /// @param name  for messages
    /// @throws Error  Internal: the driver's first line on what it refuses
    [[nodiscard]] static Program
    compute(const char* name, std::string_view shared, std::string_view body);
    /// A vertex and a fragment shader, each after the shared part.
    /// @throws as compute
    [[nodiscard]] static Program draw(const char* name,
                                      std::string_view shared,
                                      std::string_view vertex,
                                      std::string_view fragment);
    ~Program();
    Program(Program&& other) noexcept : id_(other.id_) { other.id_ = 0; }
    Program& operator=(Program&&) = delete;
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void use() const;
    /// Sets a uniform by its name; one that the program does not use is ignored.
    void set(const char* name, std::int32_t value) const;
    void set(const char* name, std::uint32_t value) const;
    void set(const char* name, float value) const;
    void set(const char* name, Vec3f value) const;
    void set(const char* name, Vec3i value) const;
    /// Runs one invocation for each of `items`: as many groups along x as every driver takes, the
    /// rest along y. Waits for nothing.
    void dispatch(std::uint64_t items) const;
    /// Runs as many groups as three words at `offset` of the bound indirect buffer say.
    void dispatch_indirect(std::size_t offset) const;

private:
    explicit Program(std::uint32_t id) : id_(id) {}
    std::uint32_t id_ = 0;
};

/// What shaders wrote to buffers is there for shaders, indirect draws and reads that follow.
void finish_writes();

} // namespace heddle::opengl
