#pragma once

#include <string_view>

namespace heddle::raster {

/// GLSL, vertex: the stretch between two slices seen along `axis`, as a quad that holds it.
inline constexpr std::string_view kQuadGlsl = R"(
layout(std430, binding = 2) readonly buffer List { uint list[]; };
uniform int axis;
uniform ivec3 view_lo;  // subvoxels
uniform ivec3 view_size;
flat out uint slab;
flat out vec4 place_a, place_b;     // center, scale
flat out vec4 tangent_a, tangent_b; // tangent, turn
flat out vec4 normal_a, normal_b;   // normal; layer, colour
flat out vec3 sizes;                // extent and fiber's radius, model units; reach, units

vec2 across(vec3 v) { return axis == 0 ? v.yz : axis == 1 ? v.xz : v.xy; }

void main() {
    slab = list[gl_InstanceID];
    Slice a = slices[slab];
    Slice b = slices[slab + 1u];
    vec3 chord = b.center - a.center;
    float n = length(chord);
    vec3 along = n > 0.0 ? chord / n : a.tangent;
    float reach = reach_of(a, b);
    place_a = vec4(a.center, a.scale);
    place_b = vec4(b.center, b.scale);
    tangent_a = vec4(a.tangent, a.turn);
    tangent_b = vec4(b.tangent, b.turn);
    normal_a = vec4(a.normal, float(a.layer));
    normal_b = vec4(b.normal, float(a.color & 0xffffffu)); // 24 bits: exact
    sizes = vec3(a.extent, a.fiber_radius, reach);
    vec2 t = across(along);
    float tilt = length(t);
    vec2 e = tilt > 1e-6 ? t / tilt : vec2(1.0, 0.0);
    // a disc seen along the axis is an ellipse with these two axes; half a subvoxel is for rounding
    float pad = 0.5 * max(edge.x, max(edge.y, edge.z));
    float half_e = reach * abs(along[axis]) + half_length(a, b, reach) * tilt + pad;
    float half_d = reach + half_length(a, b, reach) * length(b.tangent - a.tangent) + pad;
    vec2 corner = vec2((gl_VertexID & 1) == 0 ? -1.0 : 1.0, (gl_VertexID & 2) == 0 ? -1.0 : 1.0);
    vec2 at = across(0.5 * (a.center + b.center)) + corner.x * half_e * e +
              corner.y * half_d * vec2(-e.y, e.x);
    vec2 pixel = at / across(edge) - across(vec3(view_lo));
    gl_Position = vec4(2.0 * pixel / across(vec3(view_size)) - 1.0, 0.0, 1.0);
}
)";

/// GLSL, fragment: the ray through a column's centre, cut to a stretch; `local` is where it passes the
/// section.
inline constexpr std::string_view kSlabGlsl = R"(
layout(std430, binding = 1) readonly buffer Slots { uint slot_of[]; };
layout(std430, binding = 3) buffer Pool { uint pool[]; };
layout(binding = 0) uniform sampler2DArray section_distance;
layout(binding = 1) uniform sampler2DArray section_color;
uniform int axis;
uniform ivec3 view_lo;
uniform float weight_scale; // of 1 unit^3 over a fiber's radius in units
flat in uint slab;
flat in vec4 place_a, place_b;
flat in vec4 tangent_a, tangent_b;
flat in vec4 normal_a, normal_b;
flat in vec3 sizes;

vec3 along;       // unit, from a to b
float chord;      // units, from a to b
float bend;       // |tangent of b - that of a|
vec3 bulge;       // the centreline's way off the chord is f (1 - f) times this
vec3 ray;         // its place at t = 0
vec2 plane_a;     // height over a's plane is plane_a.x + plane_a.y t
vec2 plane_b;

struct Local { vec2 at; float scale; float rise; vec3 normal, binormal; }; // at: model units

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

vec2 plane_of(vec3 center, vec3 tangent) {
    return vec2(dot(tangent, ray - center), tangent[axis]);
}

// Cuts [range.x, range.y) to where the height over a plane is >= 0, or to where it is below.
void cut(inout vec2 range, vec2 plane, bool above) {
    if (plane.y == 0.0) {
        if ((plane.x >= 0.0) != above) range.y = range.x;
        return;
    }
    float t = -plane.x / plane.y;
    if ((plane.y > 0.0) == above) range.x = max(range.x, t);
    else range.y = min(range.y, t);
}

// The ray's part between the two slices and near their yarn.
vec2 range_of_slab() {
    vec3 center = 0.5 * (place_a.xyz + place_b.xyz);
    vec3 from = ray - center;
    float far = length(vec2(sizes.z, 0.5 * chord + sizes.z * bend)) + 0.01;
    from[axis] = 0.0;
    float room = far * far - dot(from, from);
    vec2 range = vec2(center[axis]) + vec2(-1.0, 1.0) * sqrt(max(room, 0.0));
    if (room <= 0.0) range.y = range.x;
    cut(range, plane_a, true);
    cut(range, plane_b, false);
    // not cut to the region: where steps start would show in its voxels
    float deep = edge[axis] * float(subvoxels);
    if (range.y <= float(voxel_lo[axis]) * deep || range.x >= float(voxel_hi[axis]) * deep) {
        range.y = range.x;
    }
    return range;
}

void start(ivec2 pixel) {
    vec3 d = place_b.xyz - place_a.xyz;
    chord = length(d);
    along = chord > 0.0 ? d / chord : tangent_a.xyz;
    bend = length(tangent_b.xyz - tangent_a.xyz);
    bulge = 0.5 * chord * (tangent_a.xyz - tangent_b.xyz); // Hermite's curve of both tangents
    ray = lift(pixel);
    plane_a = plane_of(place_a.xyz, tangent_a.xyz);
    plane_b = plane_of(place_b.xyz, tangent_b.xyz);
}

Local local_at(float t) {
    float before = plane_a.x + plane_a.y * t;
    float behind = -(plane_b.x + plane_b.y * t);
    Local l;
    l.rise = before + behind;
    float f = clamp(before / max(l.rise, 1e-6), 0.0, 1.0);
    vec3 p = ray + t * unit_axis() - mix(place_a.xyz, place_b.xyz, f) - f * (1.0 - f) * bulge;
    vec3 lerped = mix(normal_a.xyz, normal_b.xyz, f);
    l.normal = normalize(lerped - dot(lerped, along) * along);
    l.binormal = cross(along, l.normal);
    l.scale = mix(place_a.w, place_b.w, f);
    l.at = vec2(dot(p, l.normal), dot(p, l.binormal)) / l.scale;
    return l;
}

vec3 layer_place(vec2 at) { return vec3(0.5 + 0.5 * at / sizes.x, normal_a.w); }

// Model units, to the nearest fiber's surface; below 0 inside. Past the image: at least so much.
float distance_at(vec2 at) {
    float d = textureLod(section_distance, layer_place(at), 0.0).x;
    float past = max(abs(at.x), abs(at.y)) - sizes.x;
    return past > 0.0 ? max(d, past) : d;
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

vec3 direction_of(Local l) {
    return fiber_direction(l.at * l.scale, tangent_a.w, l.rise, l.normal, l.binormal, along);
}

vec3 color_of(Local l) {
    return textureLod(section_color, layer_place(l.at), 0.0).rgb * unpackUnorm4x8(uint(normal_b.w)).rgb;
}

// Directed area of `depth` units of a column inside a fiber: volume x 2 / (pi r).
int weight_of(float depth, float scale) {
    float area = axis == 0 ? edge.y * edge.z : axis == 1 ? edge.x * edge.z : edge.x * edge.y;
    float w = weight_scale * 0.63661977 * area * depth / (sizes.y * scale);
    return max(1, int(min(w + 0.5, 1.0e6)));
}
)";

} // namespace heddle::raster
