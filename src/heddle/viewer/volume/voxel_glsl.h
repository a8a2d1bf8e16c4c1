#pragma once

#include <string_view>

namespace heddle::viewer {

/// GLSL, fragment: the light that reaches a point, by cone tracing towards the light, one level
/// coarser than the lit voxel and coarser still with distance. Needs kVoxelWalkGlsl.
inline constexpr std::string_view kVoxelShadowGlsl = R"(
uniform vec3 to_light; // unit

const int kSteps = 8;  // in each of three levels: 112 voxels of the lit level

// @param point  from voxel_middle
float lit_at(vec3 point, int level) {
    float depth = 0.0;
    float far = 1.5 * voxel_levels[min(level + 1, voxel_range.y)].per.w; // past the lit voxel
    for (int i = 0; i < 3 * kSteps && depth < 4.0; ++i) {
        int l = min(level + 1 + i / kSteps, voxel_range.y);
        float step = voxel_levels[l].per.w;
        int number = voxel_at_offset(point + (far + 0.5 * step) * to_light, l);
        if (number >= 0) {
            vec3 k = voxel_depth(voxel_depths[number]) * density_scale;
            depth += length(k * to_light * voxel_levels[l].per.xyz) * step;
        }
        far += step;
    }
    return exp(-depth);
}
)";

/// GLSL, fragment: the colours of voxels. `Shaded` follows the model of slices in kShadeGlsl; with
/// the light at the eye it follows preview.cpp. Constants of the program: `color_mode`, a
/// VoxelColor; `eye_light`, 1: the light is at the eye; `shadows`, 1 or 0.            [Kajiya 1989]
inline constexpr std::string_view kVoxelColorGlsl = R"(
uniform vec3 to_eye; // unit, in the middle of the picture

const float kAmbient = 0.25; // as in kShadeGlsl

vec3 heat(float x) { // blue, green, yellow, red
    return vec3(clamp(2.0 * x - 0.4, 0.0, 1.0), 1.0 - abs(2.0 * x - 0.9),
                clamp(1.0 - 2.2 * x, 0.0, 1.0));
}

const vec3 kDensityColors[5] =
    vec3[](vec3(0.02, 0.05, 0.6), vec3(0.0, 0.45, 0.7), vec3(0.1, 0.6, 0.1), vec3(0.85, 0.7, 0.0),
           vec3(0.75, 0.02, 0.02));

vec3 density_color(float density) {
    float x = 4.0 * clamp(density, 0.0, 1.0);
    int i = min(int(x), 3);
    return mix(kDensityColors[i], kDensityColors[i + 1], x - float(i));
}

vec3 palette(uint id) {
    float hue = 6.0 * fract(float(id % 4096u) * 0.61803398875 + 0.05); // golden ratio
    vec3 x = abs(mod(vec3(hue) + vec3(0.0, 4.0, 2.0), 6.0) - 3.0) - 1.0;
    return 0.15 + 0.75 * clamp(x, 0.0, 1.0);
}

uint hash_block(ivec3 block) {
    uint h = uint(block.x) * 73856093u ^ uint(block.y) * 19349663u ^ uint(block.z) * 83492791u;
    h = (h ^ (h >> 15)) * 0x85ebca6bu;
    return (h ^ (h >> 13)) % 97u;
}

struct Lit { vec3 ambient; vec3 direct; };

Lit lit_from_eye(vec3 color, vec3 axis, float wide, bool fiber) {
    float along = abs(dot(axis, to_eye));
    float facing = fiber ? sqrt(max(0.0, 1.0 - along * along)) : along;
    float f = mix(facing, 0.75, wide);
    float shine = 0.12 * (1.0 - wide) * pow(f, 16.0);
    // voxels behind others are in their shadow
    return Lit((color * (0.12 + 0.88 * f * f) + shine) * (0.5 + 0.5 * through), vec3(0.0));
}

Lit lit_from_light(vec3 color, vec3 axis, float wide, bool fiber) {
    float along_light = dot(axis, to_light);
    float along_eye = -dot(axis, ray.way);
    float across_light = sqrt(max(0.0, 1.0 - along_light * along_light));
    float across_eye = sqrt(max(0.0, 1.0 - along_eye * along_eye));
    float mirrored = fiber ? across_light * across_eye - along_light * along_eye
                           : 2.0 * along_light * along_eye + dot(to_light, ray.way);
    float facing = mix(fiber ? across_light : abs(along_light), 0.75, wide);
    float shine = 0.12 * (1.0 - wide) * pow(max(0.0, mirrored), 24.0);
    if (shadows == 1 && !fiber && along_light * along_eye < 0.0) { // seen from its dark side
        facing *= wide;
        shine = 0.0;
    }
    // parts that face the eye are brighter: this shows shapes in shadows
    float ambient = kAmbient * mix(0.5, 1.0, fiber ? across_eye : abs(along_eye));
    return Lit(color * ambient, color * (1.0 - kAmbient) * facing + shine);
}

Lit shade(int number, int level, ivec3 at) {
    uint depths = voxel_depths[number];
    uint axes = voxel_axes[number];
    float wide = float(depths >> 24) / 255.0;
    vec3 color = vec3(0.0);
    if (color_mode == 0 || color_mode == 2) {
        uint colors = voxel_colors[number];
        vec3 axis = voxel_axis(colors, axes);
        vec3 root = unpackUnorm4x8(colors).xyz;
        bool fiber = (axes >> 24 & 8u) != 0u;
        if (color_mode == 2) return Lit(axis * axis, vec3(0.0));
        if (eye_light == 1) return lit_from_eye(root * root, axis, wide, fiber);
        return lit_from_light(root * root, axis, wide, fiber);
    }
    if (color_mode == 1) color = density_color(voxel_density(voxel_depth(depths)));
    if (color_mode == 3) color = heat(wide);
    if (color_mode == 4) color = palette(axes >> 16 & 0xffu);
    if (color_mode == 5) color = palette(hash_block(block_of(level, at)));
    if (color_mode == 6) color = palette(uint(voxel_levels[level].corner.w));
    return Lit(color, vec3(0.0));
}

// A solid white voxel with dark edges, if pixels resolve them.
vec3 white_cell(int level, ivec3 at, float t) {
    vec3 per = voxel_levels[level].per.xyz;
    vec3 p = (ray.from + t * ray.way) * per + voxel_levels[level].shift.xyz - vec3(at);
    vec3 edge = min(abs(p), abs(p - 1.0)) / per; // scene units, from the faces
    float face = min(edge.x, min(edge.y, edge.z));
    float second = edge.x + edge.y + edge.z - face - max(edge.x, max(edge.y, edge.z));
    vec3 normal = vec3(equal(edge, vec3(face)));
    float pixel = pixel_width(ray, t);
    float seen = clamp(0.5 * (voxel_levels[level].shift.w / pixel - 3.0), 0.0, 1.0);
    float line = seen * clamp(1.5 - second / pixel, 0.0, 1.0);
    float tone = 0.65 + 0.3 * dot(abs(normal), abs(vec3(0.8, 1.0, 0.6)));
    return mix(vec3(tone), vec3(0.05), line);
}
)";

/// GLSL, fragment: the ray of a pixel through all voxels.
inline constexpr std::string_view kVoxelMainGlsl = R"(
layout(location = 0) out vec4 result; // linear, times alpha

vec3 sum;
vec3 clump_direct; // of the current clump, without shadows
float clump_hidden, clump_t;

void meet(int number, int level, ivec3 at, float hidden, float t) {
    if (white == 1 && block_of(level, at) == white_block) {
        sum += hidden * white_cell(level, at, t);
        return;
    }
    Lit lit = shade(number, level, at);
    sum += hidden * lit.ambient;
    clump_direct += hidden * lit.direct;
    clump_hidden += hidden;
    clump_t += hidden * t;
}

// Traces one ray to the light from the middle of the opaque part of a clump.
void leave_clump(int level) {
    float lit = 1.0;
    if (shadows == 1 && clump_hidden > 0.01) {
        lit = lit_at(ray.from + clump_t / clump_hidden * ray.way, level);
    }
    sum += lit * clump_direct;
    clump_direct = vec3(0.0);
    clump_hidden = 0.0;
    clump_t = 0.0;
}

void main() {
    ray = voxel_ray(gl_FragCoord.xy);
    sum = vec3(0.0);
    clump_direct = vec3(0.0);
    clump_hidden = 0.0;
    clump_t = 0.0;
    walk_ray(kNever);
    if (through == 1.0) discard;
    result = vec4(sum, 1.0 - through);
}
)";

} // namespace heddle::viewer
