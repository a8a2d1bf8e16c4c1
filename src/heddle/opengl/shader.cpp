#include <heddle/base/error.h>
#include <heddle/opengl/shader.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>

namespace heddle::opengl {
namespace {

constexpr std::uint32_t kGroupsAcross = 32768; ///< every driver allows 65535 along an axis
constexpr std::uint32_t kGroup = 64;

constexpr std::string_view kVersion = "#version 450 core\n";
constexpr std::string_view kComputeVersion = R"(#version 450 core
layout(local_size_x = 64) in;
uint item() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x +
           gl_LocalInvocationID.x;
}
)";

std::string first_line(std::string log) {
    log.resize(std::min(log.find('\n'), log.size()));
    return log;
}

/// @param get  glGetShaderInfoLog or glGetProgramInfoLog
template <typename Get>
std::string log_of(GLuint id, const Get& get) {
    std::string log(1024, '\0');
    GLsizei length = 0;
    get(id, 1024, &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    return log;
}

[[noreturn]] void refuse(const char* name, const char* what, const std::string& log) {
    throw Error(ErrorCode::Internal,
                str("opengl: the driver does not ", what, " '", name, "': ", first_line(log)),
                "try another driver, or --backend sample");
}

GLuint compile(GLenum kind, const char* name, std::string_view shared, std::string_view body) {
    const std::string_view head = kind == GL_COMPUTE_SHADER ? kComputeVersion : kVersion;
    const std::array<const char*, 3> text{head.data(), shared.data(), body.data()};
    const std::array<GLint, 3> size{static_cast<GLint>(head.size()),
                                    static_cast<GLint>(shared.size()),
                                    static_cast<GLint>(body.size())};
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 3, text.data(), size.data());
    glCompileShader(shader);
    GLint ok = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok == GL_TRUE) return shader;
    const std::string log = log_of(shader, glGetShaderInfoLog);
    glDeleteShader(shader);
    refuse(name, "compile", log);
}

GLuint link(const char* name, std::initializer_list<GLuint> shaders) {
    const GLuint program = glCreateProgram();
    for (const GLuint shader : shaders) glAttachShader(program, shader);
    glLinkProgram(program);
    for (const GLuint shader : shaders) {
        glDetachShader(program, shader);
        glDeleteShader(shader);
    }
    GLint ok = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok == GL_TRUE) return program;
    const std::string log = log_of(program, glGetProgramInfoLog);
    glDeleteProgram(program);
    refuse(name, "link", log);
}

} // namespace

Program Program::compute(const char* name, std::string_view shared, std::string_view body) {
    return Program(link(name, {compile(GL_COMPUTE_SHADER, name, shared, body)}));
}

Program Program::draw(const char* name,
                      std::string_view shared,
                      std::string_view vertex,
                      std::string_view fragment) {
    const GLuint first = compile(GL_VERTEX_SHADER, name, shared, vertex);
    return Program(link(name, {first, compile(GL_FRAGMENT_SHADER, name, shared, fragment)}));
}

Program::~Program() {
    if (id_ != 0) glDeleteProgram(id_);
}

void Program::use() const {
    glUseProgram(id_);
}

void Program::set(const char* name, std::int32_t value) const {
    glProgramUniform1i(id_, glGetUniformLocation(id_, name), value);
}

void Program::set(const char* name, std::uint32_t value) const {
    glProgramUniform1ui(id_, glGetUniformLocation(id_, name), value);
}

void Program::set(const char* name, float value) const {
    glProgramUniform1f(id_, glGetUniformLocation(id_, name), value);
}

void Program::set(const char* name, Vec3f value) const {
    glProgramUniform3f(id_, glGetUniformLocation(id_, name), value.x, value.y, value.z);
}

void Program::set(const char* name, Vec3i value) const {
    glProgramUniform3i(id_, glGetUniformLocation(id_, name), value.x, value.y, value.z);
}

void Program::dispatch(std::uint64_t items) const {
    if (items == 0) return;
    use();
    const std::uint64_t groups = (items + kGroup - 1) / kGroup;
    const std::uint64_t rows = (groups + kGroupsAcross - 1) / kGroupsAcross;
    glDispatchCompute(static_cast<GLuint>((groups + rows - 1) / rows), static_cast<GLuint>(rows),
                      1);
}

void Program::dispatch_indirect(std::size_t offset) const {
    use();
    glDispatchComputeIndirect(static_cast<GLintptr>(offset));
}

void finish_writes() {
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

} // namespace heddle::opengl
