#pragma once

#include <string_view>

namespace heddle::viewer {

/// GLSL, vertex: edges of blocks as quads around lines one pixel wide. Needs kVoxelEyeGlsl.
inline constexpr std::string_view kEdgeQuadGlsl = R"(
// First corner, from voxel_middle; axis.
layout(std430, binding = 14) readonly buffer Edges { vec4 edges[]; };
uniform vec3 block_size;
flat out vec4 ends;  // pixels
flat out vec4 edge;

vec3 seen(vec3 v) { return vec3(dot(right, v), dot(up, v), dot(away, v)) + vec3(0.0, 0.0, near); }

vec2 pixel_of(vec3 p) {
    return 0.5 * screen.xy + p.xy / (parallel == 1 ? screen.z : p.z * screen.z);
}

void main() {
    edge = edges[gl_InstanceID];
    vec3 along = vec3(equal(ivec3(0, 1, 2), ivec3(int(edge.w)))) * block_size;
    vec3 a = seen(edge.xyz - start);
    vec3 b = seen(edge.xyz + along - start);
    float min_distance = 1e-3 * length(along); // in front of the eye
    if (parallel == 0 && max(a.z, b.z) <= min_distance) {
        gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
        return;
    }
    if (parallel == 0 && a.z < min_distance) a = mix(a, b, (min_distance - a.z) / (b.z - a.z));
    if (parallel == 0 && b.z < min_distance) b = mix(b, a, (min_distance - b.z) / (a.z - b.z));
    vec2 p = pixel_of(a);
    vec2 q = pixel_of(b);
    vec2 line = q - p;
    vec2 e = length(line) > 1e-6 ? line / length(line) : vec2(1.0, 0.0);
    float s = (gl_VertexID & 2) == 0 ? -1.0 : 1.0;
    vec2 at = ((gl_VertexID & 1) == 0 ? p - e : q + e) + s * 1.5 * vec2(-e.y, e.x);
    ends = vec4(p, q);
    gl_Position = vec4(2.0 * at / screen.xy - 1.0, 0.0, 1.0);
}
)";

/// GLSL, fragment: a line over the picture, dimmed by voxels before it. Needs kVoxelWalkGlsl.
inline constexpr std::string_view kEdgeLineGlsl = R"(
flat in vec4 ends;
flat in vec4 edge;
layout(location = 0) out vec4 result; // linear, times alpha

const vec3 kColor = vec3(0.75, 0.03, 0.03);
const float kDim = 0.2; // brightness of a hidden line

void meet(int number, int level, ivec3 at, float hidden, float t) {}
void leave_clump(int level) {}

// The distance along its ray at which a pixel is closest to the edge.
float distance_on_ray() {
    vec3 u = vec3(equal(ivec3(0, 1, 2), ivec3(int(edge.w))));
    vec3 apart = ray.from - edge.xyz;
    float b = dot(ray.way, u);
    return (b * dot(u, apart) - dot(ray.way, apart)) / max(1.0 - b * b, 1e-6);
}

void main() {
    vec2 line = ends.zw - ends.xy;
    vec2 apart = gl_FragCoord.xy - ends.xy;
    float along = clamp(dot(apart, line) / max(dot(line, line), 1e-12), 0.0, 1.0);
    float cover = clamp(1.0 - length(apart - along * line), 0.0, 1.0);
    if (!(cover > 0.0)) discard;
    ray = voxel_ray(gl_FragCoord.xy);
    walk_ray(distance_on_ray());
    float alpha = cover * mix(kDim, 1.0, through);
    result = vec4(kColor * alpha, alpha);
}
)";

} // namespace heddle::viewer
