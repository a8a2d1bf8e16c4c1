#include <heddle/opengl/empty_framebuffer.h>

#include <epoxy/gl.h>

namespace heddle::opengl {

EmptyFramebuffer::EmptyFramebuffer() {
    glCreateFramebuffers(1, &frame_);
    glCreateVertexArrays(1, &vertices_);
}

EmptyFramebuffer::~EmptyFramebuffer() {
    glDeleteFramebuffers(1, &frame_);
    glDeleteVertexArrays(1, &vertices_);
}

void EmptyFramebuffer::bind(std::int32_t width, std::int32_t height) const {
    glNamedFramebufferParameteri(frame_, GL_FRAMEBUFFER_DEFAULT_WIDTH, width);
    glNamedFramebufferParameteri(frame_, GL_FRAMEBUFFER_DEFAULT_HEIGHT, height);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    glBindVertexArray(vertices_);
    glViewport(0, 0, width, height);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
}

void EmptyFramebuffer::draw_indirect() {
    glDrawArraysIndirect(GL_TRIANGLE_STRIP, nullptr);
}

} // namespace heddle::opengl
