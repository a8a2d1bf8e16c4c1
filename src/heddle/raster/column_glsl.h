#pragma once

#include <string_view>

namespace heddle::raster {

/// GLSL, all stages: the segment seen along `axis`, as a rectangle that contains it. Needs
/// kSegmentGlsl, in fragment shaders kSegmentRayGlsl.
inline constexpr std::string_view kRectangleGlsl = R"(
uniform int axis;
uniform ivec3 window_lo; // subvoxels
uniform ivec3 window_size;

vec2 across(vec3 v) { return axis == 0 ? v.yz : axis == 1 ? v.xz : v.xy; }
ivec2 across(ivec3 v) { return axis == 0 ? v.yz : axis == 1 ? v.xz : v.xy; }

// units; `size` is half the length along `way` and across it
struct Rectangle { vec2 middle, way, size; };

// The pixels in the rectangle with the first pad are drawn. Pixels are found with the second pad,
// which exceeds the first by more than rounding errors: so quads and loops draw the same pixels.
const float kDrawnPad = 0.5; // longest edges of a subvoxel
const float kFoundPad = 0.625;

Rectangle rectangle_of_segment(float pad) {
    vec3 d = center_b.xyz - center_a.xyz;
    float n = length(d);
    vec3 unit = n > 0.0 ? d / n : tangent_a.xyz;
    float bent = length(tangent_b.xyz - tangent_a.xyz);
    float half_long = 0.5 * n + sizes.z * bent;
    vec2 t = across(unit);
    float tilt = length(t);
    Rectangle r;
    r.middle = across(0.5 * (center_a.xyz + center_b.xyz));
    r.way = tilt > 1e-6 ? t / tilt : vec2(1.0, 0.0);
    // a disc seen along the axis is an ellipse with these two axes
    r.size = vec2(sizes.z * abs(unit[axis]) + half_long * tilt, sizes.z + half_long * bent) +
             pad * max(edge.x, max(edge.y, edge.z));
    return r;
}
)";

/// GLSL, vertex, comes last: a quad that covers the segment's pixels.
inline constexpr std::string_view kQuadGlsl = R"(
void main() {
    current_segment();
    Rectangle r = rectangle_of_segment(kFoundPad);
    vec2 at = r.middle + corner().x * r.size.x * r.way +
              corner().y * r.size.y * vec2(-r.way.y, r.way.x);
    vec2 pixel = at / across(edge) - vec2(across(window_lo));
    gl_Position = vec4(2.0 * pixel / vec2(across(window_size)) - 1.0, 0.0, 1.0);
}
)";

/// GLSL, fragment, comes last: a pixel of the quad.
inline constexpr std::string_view kFragmentGlsl = R"(
void main() { draw_pixel(ivec2(floor(gl_FragCoord.xy)) + across(window_lo)); }
)";

/// GLSL, compute, comes last: the same pixels, row by row of the rectangle.
inline constexpr std::string_view kSegmentLoopGlsl = R"(
layout(std430, binding = 4) buffer Draw {
    uint corners, listed, first, base, groups[3], max_pixels;
};
uniform int first_turn; // of kTurns; the first sets `max_pixels` to those of the largest segment

// Pixels of an invocation in one dispatch. Software drivers silently end the loops of a shader
// after 65535 iterations, counted over all loops.
const int kTurns = 64;

float away_from_zero(float x) { return x < 0.0 ? min(x, -1e-6) : max(x, 1e-6); }

// Where a row at the height `y` above the middle enters the rectangle, the intersection of two
// strips: where it enters the second of them.
float left_end(Rectangle r, float y) {
    vec2 e = vec2(away_from_zero(r.way.x), away_from_zero(r.way.y));
    return max(-y * e.y / e.x - r.size.x / abs(e.x), y * e.x / e.y - r.size.y / abs(e.y));
}

void main() {
    uint rank = item() / kSegmentLanes;
    if (rank >= listed) return;
    load_segment(list[rank]);
    Rectangle r = rectangle_of_segment(kFoundPad);
    vec2 px = across(edge);
    ivec2 window_end = across(window_lo + window_size);
    vec2 e = abs(r.way);
    float high = e.y * r.size.x + e.x * r.size.y;
    int first = max(int(floor((r.middle.y - high) / px.y - 0.5)), across(window_lo).y);
    int end = min(int(ceil((r.middle.y + high) / px.y + 0.5)), window_end.y);
    float wide = min(r.size.x / max(e.x, 1e-6), r.size.y / max(e.y, 1e-6));
    int width = int(2.0 * wide / px.x) + 2;
    int total = max(end - first, 0) * width;
    if (first_turn == 0) atomicMax(max_pixels, uint(total));
    for (int turn = first_turn; turn < first_turn + kTurns; ++turn) {
        int i = turn * int(kSegmentLanes) + int(item() % kSegmentLanes);
        if (i >= total) break;
        int y = first + i / width;
        float left = r.middle.x + left_end(r, (float(y) + 0.5) * px.y - r.middle.y);
        int x = int(floor(left / px.x - 0.5)) + i % width;
        if (x >= across(window_lo).x && x < window_end.x) draw_pixel(ivec2(x, y));
    }
}
)";

/// GLSL, fragment and compute: columns of subvoxels and the sums of voxels. Needs kSegmentRayGlsl
/// and kRectangleGlsl.
inline constexpr std::string_view kColumnGlsl = R"(
layout(std430, binding = 1) readonly buffer Slots { uint slot_of[]; };
layout(std430, binding = 3) buffer Pool { uint pool[]; };
uniform float weight_scale; // of 1 unit^3 over a fiber's radius in units

vec3 unit_axis() { return axis == 0 ? vec3(1, 0, 0) : axis == 1 ? vec3(0, 1, 0) : vec3(0, 0, 1); }

vec3 lift(ivec2 pixel) {
    vec2 p = vec2(pixel) + 0.5;
    return (axis == 0 ? vec3(0.0, p) : axis == 1 ? vec3(p.x, 0.0, p.y) : vec3(p, 0.0)) * edge;
}

// Starts the ray through a column's centre and returns its part between the two slices.
vec2 start_column(ivec2 pixel) {
    Rectangle r = rectangle_of_segment(kDrawnPad);
    vec2 from = across(lift(pixel)) - r.middle;
    vec2 off = abs(vec2(dot(from, r.way), dot(from, vec2(-r.way.y, r.way.x))));
    if (any(greaterThan(off, r.size))) return vec2(0.0);
    start(lift(pixel), unit_axis());
    vec2 range = range_of_segment();
    // not clipped to the region: the voxels would depend on where its steps start
    float deep = edge[axis] * float(subvoxels);
    if (range.y <= float(voxel_lo[axis]) * deep || range.x >= float(voxel_hi[axis]) * deep) {
        range.y = range.x;
    }
    return range;
}

const uint kNoVoxel = 0xffffffffu;
const uint kWords = 32u;

// Returns the first word of a voxel's sums, or kNoVoxel.
uint words_of(ivec3 voxel) {
    if (any(lessThan(voxel, voxel_lo)) || any(greaterThanEqual(voxel, voxel_hi))) return kNoVoxel;
    uint slot = slot_of[brick_number(voxel >> 3)];
    if (slot == 0u) return kNoVoxel;
    ivec3 c = voxel & 7;
    return ((slot - 1u) * 512u + uint((c.x * 8 + c.y) * 8 + c.z)) * kWords;
}

// Words of a voxel: 0 to 5 columns (or in 0 and 1 the sums of a density), 6 to 21 subvoxels, 22 to
// 26 the moment without zz (the weight is its trace), 27 the weight, 28 to 30 white minus colour.
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

// Returns the directed area of `depth` units of a column inside a fiber: volume x 2 / (pi r).
int weight_of(float depth, float scale) {
    float area = axis == 0 ? edge.y * edge.z : axis == 1 ? edge.x * edge.z : edge.x * edge.y;
    float w = weight_scale * 0.63661977 * area * depth / (sizes.y * scale);
    return max(1, int(min(w + 0.5, 1.0e6)));
}
)";

} // namespace heddle::raster
