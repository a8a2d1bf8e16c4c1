#include <heddle/viewer/view_target.h>

#include <heddle/base/error.h>
#include <heddle/geom/slice_image.h>

#include <epoxy/gl.h>

#include <bit>

namespace heddle::viewer {
namespace {

void check_room(const char* what) {
    if (glGetError() == GL_NO_ERROR) return;
    throw Error(ErrorCode::OutOfMemory, str("opengl: the driver has no room for ", what),
                "use a smaller picture, or fewer kinds of yarn");
}

GLuint make_array(GLenum format, std::int32_t size, std::size_t layers, GLsizei levels) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &id);
    glTextureStorage3D(id, levels, format, size, size, static_cast<GLsizei>(layers));
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER,
                        levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return id;
}

} // namespace

ViewTarget::ViewTarget(std::int32_t width, std::int32_t height) : width_(width), height_(height) {
    glCreateRenderbuffers(1, &color_);
    glNamedRenderbufferStorage(color_, GL_RGBA32F, width, height);
    glCreateFramebuffers(1, &frame_);
    glNamedFramebufferRenderbuffer(frame_, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_);
    glCreateVertexArrays(1, &vertices_);
    check_room("the picture");
}

ViewTarget::~ViewTarget() {
    glDeleteFramebuffers(1, &frame_);
    glDeleteRenderbuffers(1, &color_);
    glDeleteVertexArrays(1, &vertices_);
}

void ViewTarget::begin() const {
    const GLfloat clear[4]{};
    glClearNamedFramebufferfv(frame_, GL_COLOR, 0, clear);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    glBindVertexArray(vertices_);
    glViewport(0, 0, width_, height_);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

void ViewTarget::draw_quads(std::uint32_t count) {
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count));
}

std::vector<float> ViewTarget::read() const {
    std::vector<float> out(4 * static_cast<std::size_t>(width_) *
                           static_cast<std::size_t>(height_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, frame_);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, out.data());
    glDisable(GL_BLEND);
    return out;
}

ViewSections::ViewSections(const raster::SectionLayers& sections,
                           const std::vector<std::vector<std::uint8_t>>& light) {
    const std::int32_t n = sections.size;
    const auto levels = static_cast<GLsizei>(std::bit_width(static_cast<std::uint32_t>(n)));
    color_ = make_array(GL_RGBA8, n, sections.layers.size(), levels);
    light_ = make_array(GL_R8, n, sections.layers.size(), 1);
    check_room("the sections");
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (std::size_t i = 0; i < sections.layers.size(); ++i) {
        const auto at = static_cast<GLint>(i);
        Texture image;
        image.width = n;
        image.height = n;
        image.channels = 4;
        image.texels = sections.layers[i].color;
        GLint level = 0;
        for (const Texture& t : shrink_slice(image)) {
            const std::int32_t size =
                std::max(n >> level, 1); // odd sizes: the last row is left out
            if (level >= levels) break;
            glPixelStorei(GL_UNPACK_ROW_LENGTH, t.width);
            glTextureSubImage3D(color_, level, 0, 0, at, size, size, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                                t.texels.data());
            ++level;
        }
        glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
        glTextureSubImage3D(light_, 0, 0, 0, at, n, n, 1, GL_RED, GL_UNSIGNED_BYTE,
                            light[i].data());
    }
}

ViewSections::~ViewSections() {
    glDeleteTextures(1, &color_);
    glDeleteTextures(1, &light_);
}

void ViewSections::bind() const {
    glBindTextureUnit(1, color_);
    glBindTextureUnit(2, light_);
}

} // namespace heddle::viewer
