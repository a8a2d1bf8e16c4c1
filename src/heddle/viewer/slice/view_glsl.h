#pragma once

#include <string_view>

namespace heddle::viewer {

/// GLSL, one slice per item: moves it into the axes of the eye, z away from it; makes a depth key.
inline constexpr std::string_view kSeeGlsl = R"(
layout(std430, binding = 0) readonly buffer Placed { Slice placed[]; };
layout(std430, binding = 1) writeonly buffer Seen { Slice seen[]; };
layout(std430, binding = 2) writeonly buffer Keys { uint keys[]; };
layout(std430, binding = 3) writeonly buffer Numbers { uint numbers[]; };
uniform uint slice_count;
uniform uint capacity; // number of keys; those without a slice come last
uniform vec3 right, up, away;
uniform vec3 middle;  // a point near the visible objects, in units
uniform vec3 shift;   // the middle relative to the eye, in its axes
uniform int parallel; // 1: rays are parallel
uniform int sorted;

vec3 turned(vec3 v) { return vec3(dot(right, v), dot(up, v), dot(away, v)); }

// Ascending keys go from the farthest to the nearest; slices that start no segment come last.
uint key_of(float depth) {
    uint bits = floatBitsToUint(depth);
    uint rising = (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
    return min(~rising, 0xfffffffeu);
}

void main() {
    if (item() >= capacity) return;
    numbers[item()] = item();
    keys[item()] = 0xffffffffu;
    if (item() >= slice_count) return;
    Slice s = placed[item()];
    bool segment = (s.flags & kLastOfYarn) == 0u && item() + 1u < slice_count;
    vec3 center = s.center;
    if (segment) center = 0.5 * (s.center + placed[item() + 1u].center);
    center = turned(center - middle) + shift;
    float depth = parallel == 1 ? center.z : length(center);
    if (segment) keys[item()] = sorted == 0 ? 0u : key_of(depth);
    s.center = turned(s.center - middle) + shift;
    s.tangent = turned(s.tangent);
    s.normal = turned(s.normal);
    seen[item()] = s;
}
)";

/// GLSL, vertex: a quad over a segment, perpendicular to the ray to its middle. Needs kSegmentGlsl.
inline constexpr std::string_view kSeenQuadGlsl = R"(
void main() {
    Segment s = current_segment();
    vec3 middle = 0.5 * (s.a.center + s.b.center);
    float away = length(middle);
    vec3 toward = parallel == 1 || away == 0.0 ? vec3(0.0, 0.0, 1.0) : middle / away;
    float bend = length(s.b.tangent - s.a.tangent);
    float half_long = half_length(s.a, s.b, s.reach);
    float far = length(vec2(s.reach, half_long)) + 0.01;
    if (parallel == 0 && middle.z < -far) { // behind the eye
        gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
        return;
    }
    if (parallel == 0 && away < 1.05 * far) { // around the eye
        gl_Position = vec4(corner(), 0.0, 1.0);
        return;
    }
    vec3 side = s.along - dot(s.along, toward) * toward;
    float tilt = length(side);
    vec3 e = tilt > 1e-6 ? side / tilt : any_perpendicular(toward);
    vec3 d = cross(toward, e);
    // a disc seen at an angle is an ellipse with these two axes; nearer parts look larger
    float grow = parallel == 1 ? 1.0 : away / (away - far);
    float pad = 0.75 * pixel_width(away);
    float half_e = grow * (s.reach * abs(dot(s.along, toward)) + half_long * tilt) + pad;
    float half_d = grow * (s.reach + half_long * bend) + pad;
    vec3 at = middle + corner().x * half_e * e + corner().y * half_d * d;
    gl_Position = vec4(2.0 * at.xy / (screen.z * screen.xy), 0.0, parallel == 1 ? 1.0 : at.z);
}
)";

/// GLSL, fragment: the opacity of a segment in a pixel. Needs kSegmentRayGlsl and kEyeGlsl.
inline constexpr std::string_view kOpacityGlsl = R"(
layout(binding = 2) uniform sampler2DArray section_light;
uniform float section_size; // texels
uniform float opacity;      // multiplies the opacity of texels

// The part of the pixel's ray between the two slices, in front of the eye.
vec2 start_pixel() {
    start(ray_from(gl_FragCoord.xy), ray_way(gl_FragCoord.xy));
    vec2 range = range_of_segment();
    return parallel == 1 ? range : max(range, vec2(0.0));
}

// Steps through the segment with texels that are as large as a pixel or larger; a step is as opaque
// as its texel.
struct Steps { int count; float dt; float level; float strength; };

Steps steps_through(vec2 range) {
    float texel = 2.0 * sizes.x * center_a.w / section_size; // units
    float level = max(0.0, log2(pixel_width(0.5 * (range.x + range.y)) / max(texel, 1e-12)));
    float size = texel * exp2(level);
    int count = clamp(int(ceil((range.y - range.x) / size)), 1, 48);
    float dt = (range.y - range.x) / float(count);
    return Steps(count, dt, level, opacity * dt / size);
}

float hidden_by(float alpha, Steps steps) { return -log(1.0 - min(alpha, 0.996)) * steps.strength; }

// As direction_of, but with a centreline direction that varies smoothly from slice to slice.
vec3 smooth_direction(Local l) {
    vec3 tangent = mix(tangent_a.xyz, tangent_b.xyz, l.part);
    return fiber_direction(l.at * l.scale, tangent_a.w, l.rise, l.normal, l.binormal, tangent);
}

struct Look { float depth; vec3 color; vec3 direction; float light; float t; };

const float kOpaque = 7.0; // optical depth: 1/1000 of the light is left

Look look_through(vec2 range) {
    Steps steps = steps_through(range);
    Look sum = Look(0.0, vec3(0.0), vec3(0.0), 0.0, 0.0);
    for (int i = 0; i < steps.count && sum.depth < kOpaque; ++i) {
        float t = range.x + (float(i) + 0.5) * steps.dt;
        Local l = local_at(t);
        if (max(abs(l.at.x), abs(l.at.y)) > sizes.x) continue;
        vec4 here = textureLod(section_color, layer_point(l.at), steps.level);
        float hidden = hidden_by(here.a, steps);
        float weight = (1.0 - exp(-hidden)) * exp(-sum.depth);
        sum.depth += hidden;
        sum.color += weight * here.rgb * unpackUnorm4x8(uint(normal_b.w)).rgb;
        sum.light += weight * textureLod(section_light, layer_point(l.at), steps.level).r;
        sum.direction += weight * smooth_direction(l);
        sum.t += weight * t;
    }
    float total = max(1.0 - exp(-sum.depth), 1e-6);
    return Look(sum.depth, sum.color / total, sum.direction, sum.light / total, sum.t / total);
}

// Where half of the light from behind is blocked; the end of the range if it is not.
float half_hidden(vec2 range) {
    Steps steps = steps_through(range);
    float depth = 0.0;
    float t = range.x;
    for (int i = 0; i < steps.count; ++i) {
        t = range.x + (float(i) + 0.5) * steps.dt;
        Local l = local_at(t);
        if (max(abs(l.at.x), abs(l.at.y)) > sizes.x) continue;
        depth += hidden_by(textureLod(section_color, layer_point(l.at), steps.level).a, steps);
        if (depth >= 0.69) return t;
    }
    return range.y;
}
)";

/// GLSL, fragment: the distance of a point along its ray, in 24 bits.
inline constexpr std::string_view kDepthGlsl = R"(
uniform float depth_scale; // per unit
uniform float depth_shift;

uint depth_bits(float t) { return uint(clamp((t - depth_shift) * depth_scale, 0.0, 16777215.0)); }
)";

/// GLSL, fragment: the depth at which a segment has blocked half of the light.
inline constexpr std::string_view kNearestGlsl = R"(
layout(std430, binding = 4) buffer Nearest { uint nearest_bits[]; };

void main() {
    vec2 range = start_pixel();
    if (!(range.x < range.y)) return;
    float t = half_hidden(range);
    if (t >= range.y) return;
    uvec2 at = uvec2(gl_FragCoord.xy);
    atomicMin(nearest_bits[at.y * uint(screen.x) + at.x], depth_bits(t));
}
)";

/// GLSL, fragment: for programs that need no voxels for colour.
inline constexpr std::string_view kNoGridGlsl = R"(
vec3 grid_color(vec3 from_eye) { return vec3(0.0); }
)";

/// GLSL, fragment: the direction that voxels store at a segment; one block is white, missing voxels
/// are grey. Needs kVoxelTableGlsl.
///   [LopezMoreno17, fig. 14]
inline constexpr std::string_view kGridGlsl = R"(
uniform vec3 eye_position; // scene units
uniform float unit;     // scene units
uniform vec3 block_edge; // scene units
uniform ivec3 white_block;

vec3 grid_color(vec3 from_eye) {
    vec3 point = eye_position + unit * from_eye;
    if (ivec3(floor(point / block_edge)) == white_block) return vec3(1.0);
    vec3 axis;
    float density;
    return voxel_at(point, 0, axis, density) ? axis * axis : vec3(0.35);
}
)";

/// GLSL, fragment: the colour of a segment: Kajiya and Kay's model of a thread under one distant
/// light, the shadow map, and the occlusion of the section.                    [LopezMoreno17, 4.2]
inline constexpr std::string_view kShadeGlsl = R"(
layout(std430, binding = 4) readonly buffer Shadow { uint shadow[]; };
uniform vec3 to_light;                          // in the axes of the eye
uniform vec3 light_right, light_up, light_away; // axes of the shadow map, in the axes of the eye
uniform vec3 light_middle;                      // middle of the map, in the axes of the eye
uniform float light_pixel;                      // units
uniform int shadow_size;                        // 0: none
uniform int occlusion;
uniform int color_mode;                         // 0 shaded, 1 the fiber's direction, 2 the grid's
uniform vec3 world_x, world_y, world_z;         // in the eye's axes

vec3 in_world(vec3 v) { return vec3(dot(world_x, v), dot(world_y, v), dot(world_z, v)); }

float lit(vec3 at) {
    if (shadow_size == 0) return 1.0;
    vec3 d = at - light_middle;
    vec2 p = vec2(dot(light_right, d), dot(light_up, d)) + 0.5 * float(shadow_size);
    if (any(lessThan(p, vec2(0.0))) || any(greaterThan(p, vec2(shadow_size)))) return 1.0;
    float bias = 0.7 * sizes.z + 1.5 * light_pixel;
    uint depth = depth_bits(dot(light_away, d) - bias);
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            ivec2 q = clamp(ivec2(floor(p)) + ivec2(x, y), ivec2(0), ivec2(shadow_size - 1));
            sum += depth <= shadow[uint(q.y * shadow_size + q.x)] ? 1.0 : 0.0;
        }
    }
    return sum / 9.0;
}

vec3 shade(Look look) {
    vec3 t = normalize(look.direction);
    if (color_mode != 0) {
        vec3 w = in_world(t);
        return color_mode == 2 ? grid_color(in_world(ray + look.t * way)) : w * w;
    }
    float along_light = dot(t, to_light);
    float along_eye = -dot(t, way);
    float across_light = sqrt(max(0.0, 1.0 - along_light * along_light));
    float across_eye = sqrt(max(0.0, 1.0 - along_eye * along_eye));
    float shine = pow(max(0.0, across_light * across_eye - along_light * along_eye), 24.0);
    float open = occlusion == 0 ? 1.0 : look.light;
    float direct = lit(ray + look.t * way);
    return look.color * (0.25 * open + 0.75 * direct * across_light * mix(1.0, open, 0.5)) +
           vec3(0.12 * direct * shine);
}
)";

/// GLSL, fragment: blends a segment over those behind it.
inline constexpr std::string_view kOverGlsl = R"(
layout(location = 0) out vec4 result; // linear, times alpha

void main() {
    vec2 range = start_pixel();
    if (!(range.x < range.y)) discard;
    Look look = look_through(range);
    if (look.depth < 1e-4) discard;
    float alpha = 1.0 - exp(-look.depth);
    result = vec4(shade(look) * alpha, alpha);
}
)";

/// GLSL, fragment, for WeightedBlend: a segment behind the nearest half-opaque one gets a low
/// weight.
inline constexpr std::string_view kWeighGlsl = R"(
layout(std430, binding = 5) readonly buffer Nearest { uint nearest_bits[]; };
layout(location = 0) out vec4 sums;
layout(location = 1) out float hides;
uniform float eye_scale, eye_shift; // for the nearest depths, like depth_scale and depth_shift

void main() {
    vec2 range = start_pixel();
    if (!(range.x < range.y)) discard;
    Look look = look_through(range);
    if (look.depth < 1e-4) discard;
    uvec2 at = uvec2(gl_FragCoord.xy);
    float first = float(nearest_bits[at.y * uint(screen.x) + at.x]) / eye_scale + eye_shift;
    float weight = max(exp(-4.0 * max(look.t - first, 0.0) / sizes.z), 1e-5);
    hides = 1.0 - exp(-look.depth);
    sums = vec4(shade(look), 1.0) * (hides * weight);
}
)";

} // namespace heddle::viewer
