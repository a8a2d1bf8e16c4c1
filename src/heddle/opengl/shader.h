#pragma once

#include <heddle/base/vec.h>

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace heddle::opengl {

/// A linked shader program. Needs a current Context while it lives.
class Program {
public:
    /// Compiles a compute shader with work groups of 64. The source, which may have two parts, is
    /// preceded by `#version 450 core`, the size of the group and `uint item()`, the number of the
    /// invocation's item, which may be past the last one.
    /// @param name  for messages
    /// @throws Error  Internal: with the first line of the driver's message
    [[nodiscard]] static Program
    compute(const char* name, std::string_view shared, std::string_view body);
    /// Compiles a vertex and a fragment shader, each preceded by the shared part.
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
    /// Sets a uniform by its name; a name that the program does not use is ignored.
    void set(const char* name, std::int32_t value) const;
    void set(const char* name, std::uint32_t value) const;
    void set(const char* name, float value) const;
    void set(const char* name, Vec3f value) const;
    void set(const char* name, Vec3i value) const;
    /// Runs one invocation for each of `items`, with as many groups along x as every driver allows
    /// and the rest along y. Does not wait.
    void dispatch(std::uint64_t items) const;
    /// Runs the number of groups that is in three words at `offset` of the bound indirect buffer.
    void dispatch_indirect(std::size_t offset) const;

private:
    explicit Program(std::uint32_t id) : id_(id) {}
    std::uint32_t id_ = 0;
};

/// Makes the writes of shaders to buffers visible to later shaders, indirect draws and reads.
void finish_writes();

} // namespace heddle::opengl
