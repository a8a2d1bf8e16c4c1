#include <heddle/viewer/render_target.h>

#include <heddle/base/error.h>
#include <heddle/geom/color.h>

#include <epoxy/gl.h>

namespace heddle::viewer {
namespace {

constexpr std::int32_t kMax = 8192;

} // namespace

RenderTarget::RenderTarget(std::int32_t width, std::int32_t height)
    : width_(width), height_(height) {
    if (width < 1 || height < 1 || width > kMax || height > kMax) {
        throw Error(ErrorCode::InvalidArgument, str("view: ", width, " x ", height, " pixels"),
                    "use 1 to 8192 pixels");
    }
    glCreateTextures(GL_TEXTURE_2D, 1, &color_);
    glTextureStorage2D(color_, 1, GL_RGBA32F, width, height);
    glTextureParameteri(color_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(color_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glCreateFramebuffers(1, &frame_);
    glNamedFramebufferTexture(frame_, GL_COLOR_ATTACHMENT0, color_, 0);
    glCreateVertexArrays(1, &vertices_);
    if (glGetError() != GL_NO_ERROR) {
        throw Error(ErrorCode::OutOfMemory,
                    str("opengl: the driver has no room for ", width, " x ", height, " pixels"),
                    "use a smaller picture");
    }
}

RenderTarget::~RenderTarget() {
    glDeleteFramebuffers(1, &frame_);
    glDeleteTextures(1, &color_);
    glDeleteVertexArrays(1, &vertices_);
}

void RenderTarget::limit(std::int32_t first, std::int32_t end) const {
    glScissor(0, first, width_, end - first);
    if (first <= 0 && end >= height_)
        glDisable(GL_SCISSOR_TEST);
    else
        glEnable(GL_SCISSOR_TEST);
}

void RenderTarget::clear() const {
    const GLfloat none[4]{};
    glClearNamedFramebufferfv(frame_, GL_COLOR, 0, none);
}

void RenderTarget::begin() const {
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    glBindVertexArray(vertices_);
    glViewport(0, 0, width_, height_);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

void RenderTarget::draw_quads(std::uint32_t count) {
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count));
}

void RenderTarget::draw_all() {
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

std::vector<float> RenderTarget::read() const {
    std::vector<float> out(4 * static_cast<std::size_t>(width_) *
                           static_cast<std::size_t>(height_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, frame_);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, out.data());
    return out;
}

RgbImage RenderTarget::image() const {
    const std::vector<float> rgba = read();
    RgbImage out{width_, height_, {}};
    const auto width = static_cast<std::size_t>(width_);
    const auto height = static_cast<std::size_t>(height_);
    out.rgb.resize(3 * width * height);
    for (std::size_t i = 0; i < width * height; ++i) {
        const float* from = &rgba[4 * ((height - 1 - i / width) * width + i % width)];
        for (std::size_t c = 0; c < 3; ++c)
            out.rgb[3 * i + c] = srgb_byte(static_cast<double>(from[c] + 1.0f - from[3]));
    }
    return out;
}

void RenderTarget::bind_color(std::uint32_t unit) const {
    glBindTextureUnit(unit, color_);
}

} // namespace heddle::viewer
