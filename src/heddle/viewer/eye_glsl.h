#pragma once

#include <string_view>

namespace heddle::viewer {

/// GLSL, vertex: a triangle that covers all pixels, for RenderTarget::draw_all.
inline constexpr std::string_view kAllPixelsGlsl = R"(
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

/// GLSL: the ray of a pixel, in the axes of the eye.
inline constexpr std::string_view kEyeGlsl = R"(
uniform vec3 screen;  // width and height, pixels; width of a pixel, units; perspective: at 1
uniform int parallel; // 1: rays are parallel

vec2 aside_of(vec2 at) { return (at - 0.5 * screen.xy) * screen.z; }

vec3 ray_from(vec2 at) { return parallel == 1 ? vec3(aside_of(at), 0.0) : vec3(0.0); }

vec3 ray_way(vec2 at) {
    return parallel == 1 ? vec3(0.0, 0.0, 1.0) : normalize(vec3(aside_of(at), 1.0));
}

float pixel_width(float t) { return parallel == 1 ? screen.z : screen.z * t; }
)";

} // namespace heddle::viewer
