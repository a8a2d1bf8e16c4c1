#pragma once

#include <string_view>

namespace heddle::raster {

/// GLSL, vertex: the stretch seen along `axis`, as a quad that holds it. Needs kStretchGlsl.
inline constexpr std::string_view kQuadGlsl = R"(
uniform int axis;
uniform ivec3 view_lo;  // subvoxels
uniform ivec3 view_size;

vec2 across(vec3 v) { return axis == 0 ? v.yz : axis == 1 ? v.xz : v.xy; }

void main() {
    Stretch s = give_stretch();
    vec2 t = across(s.along);
    float tilt = length(t);
    vec2 e = tilt > 1e-6 ? t / tilt : vec2(1.0, 0.0);
    // a disc seen along the axis is an ellipse with these two axes; half a subvoxel is for rounding
    float pad = 0.5 * max(edge.x, max(edge.y, edge.z));
    float half_e = s.reach * abs(s.along[axis]) + half_length(s.a, s.b, s.reach) * tilt + pad;
    float half_d = s.reach + half_length(s.a, s.b, s.reach) * length(s.b.tangent - s.a.tangent) + pad;
    vec2 at = across(0.5 * (s.a.center + s.b.center)) + corner().x * half_e * e +
              corner().y * half_d * vec2(-e.y, e.x);
    vec2 pixel = at / across(edge) - across(vec3(view_lo));
    gl_Position = vec4(2.0 * pixel / across(vec3(view_size)) - 1.0, 0.0, 1.0);
}
)";

/// GLSL, fragment: columns of subvoxels and the sums of voxels. Needs kSlabGlsl.
inline constexpr std::string_view kColumnGlsl = R"(
layout(std430, binding = 1) readonly buffer Slots { uint slot_of[]; };
layout(std430, binding = 3) buffer Pool { uint pool[]; };
uniform int axis;
uniform ivec3 view_lo;
uniform float weight_scale; // of 1 unit^3 over a fiber's radius in units

vec3 unit_axis() { return axis == 0 ? vec3(1, 0, 0) : axis == 1 ? vec3(0, 1, 0) : vec3(0, 0, 1); }

vec3 lift(ivec2 pixel) {
    vec2 p = vec2(pixel) + 0.5;
    return (axis == 0 ? vec3(0.0, p) : axis == 1 ? vec3(p.x, 0.0, p.y) : vec3(p, 0.0)) * edge;
}

ivec2 pixel_of(vec2 fragment) {
    ivec3 lo = view_lo;
    ivec2 first = axis == 0 ? lo.yz : axis == 1 ? lo.xz : lo.xy;
    return ivec2(floor(fragment)) + first;
}

// Starts the ray through a column's centre; its part between the two slices.
vec2 start_column(ivec2 pixel) {
    start(lift(pixel), unit_axis());
    vec2 range = range_of_slab();
    // not cut to the region: where steps start would show in its voxels
    float deep = edge[axis] * float(subvoxels);
    if (range.y <= float(voxel_lo[axis]) * deep || range.x >= float(voxel_hi[axis]) * deep) {
        range.y = range.x;
    }
    return range;
}

const uint kNoVoxel = 0xffffffffu;
const uint kWords = 32u;

// First word of a voxel's sums, or kNoVoxel.
uint words_of(ivec3 voxel) {
    if (any(lessThan(voxel, voxel_lo)) || any(greaterThanEqual(voxel, voxel_hi))) return kNoVoxel;
    uint slot = slot_of[brick_number(voxel >> 3)];
    if (slot == 0u) return kNoVoxel;
    ivec3 c = voxel & 7;
    return ((slot - 1u) * 512u + uint((c.x * 8 + c.y) * 8 + c.z)) * kWords;
}

// Words of a voxel: 0 to 5 columns (or 0 and 1 what a density is made of), 6 to 21 subvoxels, 22 to 26 the
// moment but zz (the weight is its trace), 27 the weight, 28 to 30 what the colour lacks of white.
void add_direction(uint words, vec3 d, int weight, vec3 color) {
    float w = float(weight);
    atomicAdd(pool[words + 22u], uint(int(round(w * d.x * d.x))));
    atomicAdd(pool[words + 23u], uint(int(round(w * d.y * d.y))));
    atomicAdd(pool[words + 24u], uint(int(round(w * d.x * d.y))));
    atomicAdd(pool[words + 25u], uint(int(round(w * d.x * d.z))));
    atomicAdd(pool[words + 26u], uint(int(round(w * d.y * d.z))));
    atomicAdd(pool[words + 27u], uint(weight));
    if (color == vec3(1.0)) return;
    for (uint i = 0u; i < 3u; ++i) {
        atomicAdd(pool[words + 28u + i], uint(round(w * (1.0 - color[i]))));
    }
}

// Directed area of `depth` units of a column inside a fiber: volume x 2 / (pi r).
int weight_of(float depth, float scale) {
    float area = axis == 0 ? edge.y * edge.z : axis == 1 ? edge.x * edge.z : edge.x * edge.y;
    float w = weight_scale * 0.63661977 * area * depth / (sizes.y * scale);
    return max(1, int(min(w + 0.5, 1.0e6)));
}
)";

} // namespace heddle::raster
