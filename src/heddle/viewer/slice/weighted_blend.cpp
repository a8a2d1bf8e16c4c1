#include <heddle/viewer/slice/weighted_blend.h>

#include <heddle/base/error.h>
#include <heddle/viewer/eye_glsl.h>

#include <epoxy/gl.h>

#include <string_view>

namespace heddle::viewer {
namespace {

constexpr std::string_view kResolveGlsl = R"(
layout(binding = 1) uniform sampler2D sums;
layout(binding = 2) uniform sampler2D through;
layout(location = 0) out vec4 result;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(sums, at, 0);
    float alpha = 1.0 - texelFetch(through, at, 0).x;
    if (!(sum.a > 0.0)) discard;
    result = vec4(sum.rgb / sum.a * alpha, alpha);
}
)";

GLuint make_image(GLenum format, std::int32_t width, std::int32_t height) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &id);
    glTextureStorage2D(id, 1, format, width, height);
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return id;
}

} // namespace

WeightedBlend::WeightedBlend(std::int32_t width, std::int32_t height)
    : width_(width),
      height_(height),
      resolve_(opengl::Program::draw("resolve weights", "", kAllPixelsGlsl, kResolveGlsl)) {
    sums_ = make_image(GL_RGBA32F, width, height);
    through_ = make_image(GL_R32F, width, height);
    glCreateFramebuffers(1, &frame_);
    glNamedFramebufferTexture(frame_, GL_COLOR_ATTACHMENT0, sums_, 0);
    glNamedFramebufferTexture(frame_, GL_COLOR_ATTACHMENT1, through_, 0);
    const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glNamedFramebufferDrawBuffers(frame_, 2, both);
    glCreateVertexArrays(1, &vertices_);
    if (glGetError() != GL_NO_ERROR) {
        throw Error(ErrorCode::OutOfMemory,
                    str("opengl: the driver has no room for ", width, " x ", height, " weights"),
                    "use a smaller picture");
    }
}

WeightedBlend::~WeightedBlend() {
    glDeleteFramebuffers(1, &frame_);
    glDeleteTextures(1, &sums_);
    glDeleteTextures(1, &through_);
    glDeleteVertexArrays(1, &vertices_);
}

void WeightedBlend::begin() const {
    const GLfloat none[4]{};
    const GLfloat all[4]{1.0f, 1.0f, 1.0f, 1.0f};
    glClearNamedFramebufferfv(frame_, GL_COLOR, 0, none);
    glClearNamedFramebufferfv(frame_, GL_COLOR, 1, all);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    glBindVertexArray(vertices_);
    glViewport(0, 0, width_, height_);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunci(0, GL_ONE, GL_ONE);
    glBlendFunci(1, GL_ZERO, GL_ONE_MINUS_SRC_COLOR);
}

void WeightedBlend::resolve(const RenderTarget& target) const {
    glTextureBarrier();
    target.begin();
    glBindTextureUnit(1, sums_);
    glBindTextureUnit(2, through_);
    resolve_.use();
    RenderTarget::draw_all();
}

} // namespace heddle::viewer
