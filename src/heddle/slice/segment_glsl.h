#pragma once

#include <string_view>

namespace heddle::slice {

/// Comes before all other GLSL of a compute shader that draws segments: the values that a vertex
/// shader passes to its fragments become globals.
inline constexpr std::string_view kSegmentsInComputeGlsl = "#define SEGMENTS_IN_COMPUTE\n";

/// GLSL, vertex and compute: the segment between two slices, with the values that its pixels need.
/// Needs kSpanGlsl.
inline constexpr std::string_view kSegmentGlsl = R"(
layout(std430, binding = 2) readonly buffer List { uint list[]; };
#ifdef SEGMENTS_IN_COMPUTE
#define TO_PIXELS
#else
#define TO_PIXELS flat out
#endif
TO_PIXELS uint segment;
TO_PIXELS vec4 center_a, center_b;     // center, scale
TO_PIXELS vec4 tangent_a, tangent_b; // tangent, turn
TO_PIXELS vec4 normal_a, normal_b;   // normal; layer, colour
TO_PIXELS vec3 sizes;                // extent and fiber's radius, model units; reach, units

struct Segment { Slice a, b; vec3 along; float reach; };

// Loads the segment after slice `number` and sets the values for its pixels.
Segment load_segment(uint number) {
    segment = number;
    Slice a = slices[segment];
    Slice b = slices[segment + 1u];
    vec3 chord = b.center - a.center;
    float n = length(chord);
    float reach = reach_of(a, b);
    center_a = vec4(a.center, a.scale);
    center_b = vec4(b.center, b.scale);
    tangent_a = vec4(a.tangent, a.turn);
    tangent_b = vec4(b.tangent, b.turn);
    normal_a = vec4(a.normal, float(a.layer));
    normal_b = vec4(b.normal, float(a.color & 0xffffffu)); // 24 bits: exact
    sizes = vec3(a.extent, a.fiber_radius, reach);
    return Segment(a, b, n > 0.0 ? chord / n : a.tangent, reach);
}

#ifndef SEGMENTS_IN_COMPUTE
Segment current_segment() { return load_segment(list[gl_InstanceID]); }

vec2 corner() {
    return vec2((gl_VertexID & 1) == 0 ? -1.0 : 1.0, (gl_VertexID & 2) == 0 ? -1.0 : 1.0);
}
#endif
)";

/// GLSL, fragment and compute: a ray clipped to a segment; `local_at` maps a point of it to the
/// section. Needs kSpanGlsl, in compute also kSegmentGlsl.
inline constexpr std::string_view kSegmentRayGlsl = R"(
layout(binding = 0) uniform sampler2DArray section_distance;
layout(binding = 1) uniform sampler2DArray section_color;
#ifndef SEGMENTS_IN_COMPUTE
flat in uint segment;
flat in vec4 center_a, center_b;
flat in vec4 tangent_a, tangent_b;
flat in vec4 normal_a, normal_b;
flat in vec3 sizes;
#endif

vec3 along;       // unit, from a to b
float chord;      // units, from a to b
float bend;       // |tangent of b - tangent of a|
vec3 bulge;       // the centreline is f (1 - f) times this off the chord
vec3 ray;         // the point at t = 0
vec3 way;         // unit, along the ray
vec2 plane_a;     // height over a's plane is plane_a.x + plane_a.y t
vec2 plane_b;

// A point on the section (`at`: model units), and the fraction of the segment before it (`part`).
struct Local { vec2 at; float scale; float part; float rise; vec3 normal, binormal; };

vec2 plane_of(vec3 center, vec3 tangent) {
    return vec2(dot(tangent, ray - center), dot(tangent, way));
}

// Clips [range.x, range.y) to where the height above a plane is >= 0, or to where it is negative.
void cut(inout vec2 range, vec2 plane, bool above) {
    if (plane.y == 0.0) {
        if ((plane.x >= 0.0) != above) range.y = range.x;
        return;
    }
    float t = -plane.x / plane.y;
    if ((plane.y > 0.0) == above) range.x = max(range.x, t);
    else range.y = min(range.y, t);
}

// The part of the ray that is between the two slices and near their yarn.
vec2 range_of_segment() {
    vec3 center = 0.5 * (center_a.xyz + center_b.xyz);
    float far = length(vec2(sizes.z, 0.5 * chord + sizes.z * bend)) + 0.01;
    float nearest = dot(center - ray, way);
    vec3 from = ray + nearest * way - center;
    float room = far * far - dot(from, from);
    vec2 range = vec2(nearest) + vec2(-1.0, 1.0) * sqrt(max(room, 0.0));
    if (room <= 0.0) range.y = range.x;
    cut(range, plane_a, true);
    cut(range, plane_b, false);
    return range;
}

// Sets the ray that starts at `from`.
void start(vec3 from, vec3 toward) {
    vec3 d = center_b.xyz - center_a.xyz;
    chord = length(d);
    along = chord > 0.0 ? d / chord : tangent_a.xyz;
    bend = length(tangent_b.xyz - tangent_a.xyz);
    bulge = 0.5 * chord * (tangent_a.xyz - tangent_b.xyz); // the Hermite curve of both tangents
    ray = from;
    way = toward;
    plane_a = plane_of(center_a.xyz, tangent_a.xyz);
    plane_b = plane_of(center_b.xyz, tangent_b.xyz);
}

Local local_at(float t) {
    float before = plane_a.x + plane_a.y * t;
    float behind = -(plane_b.x + plane_b.y * t);
    Local l;
    l.rise = before + behind;
    float f = clamp(before / max(l.rise, 1e-6), 0.0, 1.0);
    vec3 p = ray + t * way - mix(center_a.xyz, center_b.xyz, f) - f * (1.0 - f) * bulge;
    vec3 lerped = mix(normal_a.xyz, normal_b.xyz, f);
    l.normal = normalize(lerped - dot(lerped, along) * along);
    l.binormal = cross(along, l.normal);
    l.part = f;
    l.scale = mix(center_a.w, center_b.w, f);
    l.at = vec2(dot(p, l.normal), dot(p, l.binormal)) / l.scale;
    return l;
}

vec3 layer_point(vec2 at) { return vec3(0.5 + 0.5 * at / sizes.x, normal_a.w); }

// Distance to the nearest fiber, model units; < 0 inside. Outside the image a lower bound.
float distance_at(vec2 at) {
    float d = textureLod(section_distance, layer_point(at), 0.0).x;
    float past = max(abs(at.x), abs(at.y)) - sizes.x;
    return past > 0.0 ? max(d, past) : d;
}

vec3 direction_of(Local l) {
    return fiber_direction(l.at * l.scale, tangent_a.w, l.rise, l.normal, l.binormal, along);
}

vec3 color_of(Local l) {
    vec3 yarn = unpackUnorm4x8(uint(normal_b.w)).rgb;
    return textureLod(section_color, layer_point(l.at), 0.0).rgb * yarn;
}
)";

} // namespace heddle::slice
