#pragma once

#include <string_view>

namespace heddle::viewer {

/// GLSL: slices seen from a direction: x and y in pixels, z away from the eye; a key by depth. One
/// slice an item. `turn` has the view's axes as rows.
inline constexpr std::string_view kSeeGlsl = R"(
layout(std430, binding = 0) readonly buffer Placed { Slice placed[]; };
layout(std430, binding = 1) writeonly buffer Seen { Slice seen[]; };
layout(std430, binding = 2) writeonly buffer Keys { uint keys[]; };
layout(std430, binding = 3) writeonly buffer Numbers { uint numbers[]; };
uniform uint slice_count;
uniform vec3 right, up, away;
uniform vec3 middle; // of the picture, where slices were placed
uniform vec3 shift;  // where it goes, pixels
uniform float zoom;  // pixels a unit
uniform int sorted;

vec3 turned(vec3 v) { return vec3(dot(right, v), dot(up, v), dot(away, v)); }

// Ascending keys are from the farthest to the nearest; what is no slab comes last.
uint key_of(float depth) {
    uint bits = floatBitsToUint(depth);
    uint rising = (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
    return min(~rising, 0xfffffffeu);
}

void main() {
    if (item() >= slice_count) return;
    Slice s = placed[item()];
    bool slab = (s.flags & kLastOfYarn) == 0u && item() + 1u < slice_count;
    vec3 center = s.center;
    if (slab) center = 0.5 * (s.center + placed[item() + 1u].center);
    keys[item()] = !slab ? 0xffffffffu : sorted == 0 ? 0u : key_of(dot(away, center - middle));
    numbers[item()] = item();
    s.center = turned(s.center - middle) * zoom + shift;
    s.tangent = turned(s.tangent);
    s.normal = turned(s.normal);
    s.scale *= zoom;
    seen[item()] = s;
}
)";

/// GLSL, fragment: what a slab hides of a pixel. Needs kSlabGlsl.
inline constexpr std::string_view kOpacityGlsl = R"(
layout(binding = 2) uniform sampler2DArray section_light;
uniform float section_size; // texels
uniform float opacity;      // multiplies what a texel hides

// Passes the slab in steps of a texel as large as a pixel, or larger; a step hides what its texel does.
struct Look { float depth; vec3 color; vec3 direction; float light; float z; };

Look look_through(vec2 range) {
    float texel = 2.0 * sizes.x * place_a.w / section_size; // pixels
    float level = max(0.0, -log2(max(texel, 1e-6)));
    float size = texel * exp2(level);
    int steps = clamp(int(ceil((range.y - range.x) / size)), 1, 48);
    float dt = (range.y - range.x) / float(steps);
    Look sum = Look(0.0, vec3(0.0), vec3(0.0), 0.0, 0.0);
    for (int i = 0; i < steps; ++i) {
        float t = range.x + (float(i) + 0.5) * dt;
        Local l = local_at(t);
        if (max(abs(l.at.x), abs(l.at.y)) > sizes.x) continue;
        vec4 texel_here = textureLod(section_color, layer_place(l.at), level);
        float hidden = -log(1.0 - min(texel_here.a, 0.996)) * opacity * dt / size;
        float weight = (1.0 - exp(-hidden)) * exp(-sum.depth);
        sum.depth += hidden;
        sum.color += weight * texel_here.rgb * unpackUnorm4x8(uint(normal_b.w)).rgb;
        sum.light += weight * textureLod(section_light, layer_place(l.at), level).r;
        sum.direction += weight * direction_of(l);
        sum.z += weight * t;
    }
    float total = max(1.0 - exp(-sum.depth), 1e-6);
    return Look(sum.depth, sum.color / total, sum.direction, sum.light / total, sum.z / total);
}

uint shadow_bits(float depth) { return uint(clamp(depth * 1024.0 + 4194304.0, 0.0, 8388608.0)); }
)";

/// GLSL, fragment: the depth at which a slab has hidden half of the light.
inline constexpr std::string_view kShadowGlsl = R"(
layout(std430, binding = 4) buffer Shadow { uint shadow[]; };
uniform int shadow_size;

void main() {
    ivec2 pixel = pixel_of(gl_FragCoord.xy);
    start(pixel);
    vec2 range = range_of_slab();
    if (!(range.x < range.y)) return;
    Look look = look_through(range);
    if (look.depth < 0.69) return;
    atomicMin(shadow[uint(pixel.y * shadow_size + pixel.x)], shadow_bits(look.z));
}
)";

/// GLSL, fragment: a slab's colour over what lies behind it: Kajiya and Kay's model of a thread under
/// one distant light, the shadow map, and the section's occlusion.
inline constexpr std::string_view kShadeGlsl = R"(
layout(std430, binding = 4) readonly buffer Shadow { uint shadow[]; };
layout(location = 0) out vec4 result; // linear, times alpha
uniform vec3 to_light;                // in the view's axes
uniform vec3 light_right, light_up, light_away; // of the shadow map, in the view's axes
uniform vec3 light_shift;
uniform vec3 view_middle;
uniform int shadow_size; // 0: none
uniform int occlusion;

float lit(vec3 at, float bias) {
    if (shadow_size == 0) return 1.0;
    vec3 d = at - view_middle;
    vec3 p = vec3(dot(light_right, d), dot(light_up, d), dot(light_away, d)) + light_shift;
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            ivec2 q = clamp(ivec2(floor(p.xy)) + ivec2(x, y), ivec2(0), ivec2(shadow_size - 1));
            uint nearest = shadow[uint(q.y * shadow_size + q.x)];
            sum += shadow_bits(p.z - bias) <= nearest ? 1.0 : 0.0;
        }
    }
    return sum / 9.0;
}

void main() {
    ivec2 pixel = pixel_of(gl_FragCoord.xy);
    start(pixel);
    vec2 range = range_of_slab();
    if (!(range.x < range.y)) discard;
    Look look = look_through(range);
    if (look.depth < 1e-4) discard;
    vec3 t = normalize(look.direction);
    float along_light = dot(t, to_light);
    float along_eye = -t.z;
    float across_light = sqrt(max(0.0, 1.0 - along_light * along_light));
    float across_eye = sqrt(max(0.0, 1.0 - along_eye * along_eye));
    float shine = pow(max(0.0, across_light * across_eye - along_light * along_eye), 24.0);
    float open = occlusion == 0 ? 1.0 : look.light;
    float direct = lit(vec3(vec2(pixel) + 0.5, look.z), 0.7 * sizes.z * length(light_away) + 1.5);
    vec3 color = look.color * (0.25 * open + 0.75 * direct * across_light * mix(1.0, open, 0.5)) +
                 vec3(0.12 * direct * shine);
    float alpha = 1.0 - exp(-look.depth);
    result = vec4(color * alpha, alpha);
}
)";

} // namespace heddle::viewer
