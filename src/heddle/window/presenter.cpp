#include <heddle/window/presenter.h>

#include <heddle/viewer/eye_glsl.h>

#include <epoxy/gl.h>

#include <string_view>

namespace heddle::window {
namespace {

constexpr std::string_view kShowGlsl = R"(
layout(binding = 0) uniform sampler2D fine;
layout(binding = 1) uniform sampler2D coarse;
uniform int rows_done;
layout(location = 0) out vec4 result;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    ivec2 size = textureSize(fine, 0);
    vec4 c = at.y < rows_done
                 ? texelFetch(fine, min(at, size - 1), 0)
                 : textureLod(coarse, gl_FragCoord.xy / vec2(size), 0.0);
    vec3 x = clamp(c.rgb + 1.0 - c.a, 0.0, 1.0); // over white
    vec3 srgb = mix(1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, 12.92 * x,
                    lessThanEqual(x, vec3(0.0031308)));
    result = vec4(srgb, 1.0);
}
)";

} // namespace

Presenter::Presenter()
    : program_(opengl::Program::draw("show", "", viewer::kAllPixelsGlsl, kShowGlsl)) {
    glCreateVertexArrays(1, &vertices_);
}

Presenter::~Presenter() {
    glDeleteVertexArrays(1, &vertices_);
}

void Presenter::show(const viewer::ProgressiveRenderer& picture,
                     std::int32_t width,
                     std::int32_t height) const {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glBindVertexArray(vertices_);
    glViewport(0, 0, width, height);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
    picture.fine().bind_color(0);
    picture.coarse().bind_color(1);
    program_.set("rows_done", picture.rows_done());
    program_.use();
    viewer::RenderTarget::draw_all();
}

} // namespace heddle::window
