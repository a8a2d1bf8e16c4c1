#include <heddle/base/error.h>
#include <heddle/opengl/buffer.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <utility>

namespace heddle::opengl {
namespace {

/// An empty storage block cannot be bound.
constexpr std::size_t kMinBytes = 16;

std::uint32_t make(const char* name, std::size_t bytes, const void* from) {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    glNamedBufferStorage(id, static_cast<GLsizeiptr>(bytes), from, GL_DYNAMIC_STORAGE_BIT);
    if (glGetError() == GL_NO_ERROR) return id;
    glDeleteBuffers(1, &id);
    throw Error(ErrorCode::OutOfMemory,
                str("opengl: the driver has no ", (bytes >> 20) + 1, " MiB for ", name),
                "lower --memory, or use larger voxels");
}

} // namespace

Buffer::Buffer(const char* name, std::size_t bytes)
    : id_(make(name, std::max(bytes, kMinBytes), nullptr)), bytes_(bytes) {}

Buffer::Buffer(const char* name, std::span<const std::byte> bytes) : Buffer(name, bytes.size()) {
    write(bytes);
}

Buffer::~Buffer() {
    if (id_ != 0) glDeleteBuffers(1, &id_);
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

void Buffer::bind_storage(std::uint32_t binding) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, id_);
}

void Buffer::bind_uniform(std::uint32_t binding) const {
    glBindBufferBase(GL_UNIFORM_BUFFER, binding, id_);
}

void Buffer::bind_indirect() const {
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, id_);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, id_);
}

void Buffer::clear(std::uint32_t word) const {
    glClearNamedBufferData(id_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &word);
}

void Buffer::write(std::span<const std::byte> bytes, std::size_t offset) const {
    if (bytes.empty()) return;
    glNamedBufferSubData(id_, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes.size()),
                         bytes.data());
}

void Buffer::read(std::span<std::byte> out, std::size_t offset) const {
    if (out.empty()) return;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(id_, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(out.size()),
                            out.data());
}

} // namespace heddle::opengl
