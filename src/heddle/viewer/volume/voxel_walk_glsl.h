#pragma once

#include <string_view>

namespace heddle::viewer {

/// GLSL, vertex: all pixels, as a triangle.
inline constexpr std::string_view kAllPixelsGlsl = R"(
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

/// GLSL: a camera whose rays start close to the voxels: an eye far away costs no bits of their places.
inline constexpr std::string_view kVoxelEyeGlsl = R"(
uniform vec3 screen;          // width and height, pixels; width of a pixel: scene units; not parallel: at 1
uniform int parallel;         // rays
uniform vec3 right, up, away; // axes, unit
uniform vec3 start;           // of the ray through the picture's middle, from voxel_middle
uniform float near;           // from the eye to there

struct VoxelRay {
    vec3 from;  // from voxel_middle
    vec3 way;   // unit
    float past; // from the eye to `from`
};

VoxelRay voxel_ray(vec2 at) {
    vec2 p = (at - 0.5 * screen.xy) * screen.z;
    vec3 aside = p.x * right + p.y * up;
    if (parallel == 1) return VoxelRay(start + aside, away, 0.0);
    float slant = length(away + aside);
    return VoxelRay(start + near * aside, (away + aside) / slant, near * slant);
}

float pixel_width(VoxelRay ray, float t) { return parallel == 1 ? screen.z : screen.z * (ray.past + t); }
)";

/// GLSL, fragment: a ray through occupied leaves and their voxels, front to back; what voxels hide as in
/// preview.cpp. Needs kVoxelTableGlsl, kVoxelEyeGlsl and these two, which see each voxel that hides
/// something, `hidden` of the light that there was, and the end of each leaf:
///     void meet(int number, int level, ivec3 at, float hidden, float t);
///     void leave_leaf(int level);
inline constexpr std::string_view kVoxelWalkGlsl = R"(
uniform int level_first, level_last; // that serve
uniform float level_reach;           // a level serves pixels up to this many of its edges wide
uniform vec3 box_lo, box_hi;         // of all voxels, from voxel_middle
uniform float density_scale;
uniform int white;                   // the block below is solid
uniform ivec3 white_block;

void meet(int number, int level, ivec3 at, float hidden, float t);
void leave_leaf(int level);

const float kOpaque = 0.004;  // less than this is not followed
const float kFlatWidth = 96.0 / 255.0; // these three: see preview.cpp
const float kClosing = 1.5;
const float kSheetGap = 0.5;
const float kNever = 1e30;

VoxelRay ray;
float through;    // of the light
float sheet_end;  // t where a flat surface was last met
float sheet_left; // what its voxels left of 1
vec3 weight;      // voxels of the level a unit of t, by axis
float sheet_gap;  // that a flat surface of the level may have, scene units

// Steps through the cells of a lattice that a ray crosses.
struct Walk { ivec3 at; ivec3 way; vec3 next; vec3 width; };

Walk start_walk(vec3 p, vec3 d, float t, ivec3 lo, ivec3 hi) {
    Walk w;
    bvec3 still = equal(d, vec3(0.0));
    bvec3 rises = greaterThan(d, vec3(0.0));
    vec3 per = vec3(1.0) / mix(d, vec3(1.0), still);
    w.at = clamp(ivec3(floor(p + d * t)), lo, hi);
    w.way = 2 * ivec3(rises) - 1;
    w.width = mix(abs(per), vec3(kNever), still);
    w.next = mix((vec3(w.at) + vec3(rises) - p) * per, vec3(kNever), still);
    return w;
}

float walk_end(Walk w) { return min(w.next.x, min(w.next.y, w.next.z)); }

bool advance(inout Walk w, ivec3 lo, ivec3 hi) {
    int a = w.next.x < w.next.y ? (w.next.x < w.next.z ? 0 : 2) : (w.next.y < w.next.z ? 1 : 2);
    ivec3 axis = ivec3(equal(ivec3(0, 1, 2), ivec3(a)));
    w.at += w.way * axis;
    w.next += w.width * vec3(axis);
    return all(greaterThanEqual(w.at, lo)) && all(lessThanEqual(w.at, hi));
}

// The block of a voxel.
ivec3 block_of(int level, ivec3 at) {
    ivec4 corner = voxel_levels[level].corner;
    ivec3 i = at + corner.xyz;
    return corner.w <= 5 ? i >> (5 - corner.w) : i << (corner.w - 5);
}

// What a voxel of a flat surface takes; see preview.cpp.
float hidden_by_sheet(vec3 k, uint flags, float t, float leave) {
    vec3 turn = vec3(1.0) - 2.0 * vec3(ivec3(flags, flags >> 1, flags >> 2) & 1);
    float surface = dot((vec3(1.0) - exp(-k)) * turn, weight);
    float opaque = kClosing * abs(surface) / dot(abs(weight), vec3(1.0));
    if (t > sheet_end + sheet_gap) sheet_left = 1.0;
    sheet_end = leave;
    float left = max(0.0, sheet_left - opaque);
    float hidden = sheet_left > 0.0 ? 1.0 - left / sheet_left : 1.0;
    sheet_left = left;
    return hidden;
}

void cross_voxel(int number, int level, ivec3 at, float t, float leave) {
    uint depths = voxel_depths[number];
    uint flags = voxel_axes[number] >> 24;
    vec3 k = voxel_depth(depths) * density_scale;
    float part;
    if (white == 1 && block_of(level, at) == white_block) {
        part = 1.0;
    } else if ((flags & 8u) == 0u && float(depths >> 24) / 255.0 < kFlatWidth) {
        part = hidden_by_sheet(k, flags, t, leave);
    } else {
        part = 1.0 - exp(-length(k * weight) * (leave - t));
    }
    float hidden = through * part;
    meet(number, level, at, hidden, t);
    through -= hidden;
}

void walk_leaf(int leaf, int level, ivec3 corner, vec3 p, float t, float t_end) {
    ivec3 hi = corner + 7;
    Walk w = start_walk(p, weight, t, corner, hi);
    bool inside = true;
    while (inside && t < t_end && through > kOpaque) {
        float leave = min(walk_end(w), t_end);
        if (leave > t) {
            int number = voxel_of_leaf(leaf, w.at & 7);
            if (number >= 0) cross_voxel(number, level, w.at, t, leave);
        }
        t = max(t, leave);
        inside = advance(w, corner, hi);
    }
    leave_leaf(level);
}

void walk_cell(int cell, int level, ivec3 at, vec3 p, float t, float t_end) {
    ivec3 lo = at * 16;
    ivec3 hi = lo + 15;
    Walk w = start_walk(p / 8.0, weight / 8.0, t, lo, hi);
    bool inside = true;
    while (inside && t < t_end && through > kOpaque) {
        float leave = min(walk_end(w), t_end);
        int leaf = leave > t ? voxel_leaf(cell, w.at) : -1;
        if (leaf >= 0) walk_leaf(leaf, level, w.at * 8, p, t, leave);
        t = max(t, leave);
        inside = advance(w, lo, hi);
    }
}

// What of a ray is within a box.
vec2 clip(vec3 p, vec3 d, vec3 lo, vec3 hi, vec2 range) {
    for (int a = 0; a < 3; ++a) {
        if (d[a] == 0.0) {
            if (p[a] < lo[a] || p[a] >= hi[a]) return vec2(kNever, -kNever);
            continue;
        }
        float u = (lo[a] - p[a]) / d[a];
        float v = (hi[a] - p[a]) / d[a];
        range = vec2(max(range.x, min(u, v)), min(range.y, max(u, v)));
    }
    return range;
}

void walk_level(int level, float t, float t_end) {
    vec3 p = ray.from * voxel_levels[level].per.xyz + voxel_levels[level].shift.xyz;
    weight = ray.way * voxel_levels[level].per.xyz;
    sheet_gap = kSheetGap * voxel_levels[level].shift.w;
    ivec3 leaf_lo = voxel_levels[level].lo.xyz;
    ivec3 leaf_hi = voxel_levels[level].hi.xyz;
    vec2 range = clip(p, weight, vec3(leaf_lo * 8), vec3(leaf_hi * 8 + 8), vec2(t, t_end));
    t = range.x;
    t_end = range.y;
    Walk w = start_walk(p / 128.0, weight / 128.0, t, leaf_lo >> 4, leaf_hi >> 4);
    bool inside = true;
    while (inside && t < t_end && through > kOpaque) {
        float leave = min(walk_end(w), t_end);
        int cell = leave > t ? voxel_cell(level, w.at) : -1;
        if (cell >= 0) walk_cell(cell, level, w.at, p, t, leave);
        t = max(t, leave);
        inside = advance(w, leaf_lo >> 4, leaf_hi >> 4);
    }
}

// From the ray's start to t_end: each level serves until a pixel is wider than its voxels.
void walk_ray(float t_end) {
    through = 1.0;
    sheet_end = -kNever;
    sheet_left = 1.0;
    vec2 range = clip(ray.from, ray.way, box_lo, box_hi, vec2(0.0, t_end));
    float t = range.x;
    t_end = range.y;
    for (int level = level_first; level <= level_last && t < t_end && through > kOpaque; ++level) {
        float until = t_end;
        if (level < level_last) {
            float wide = voxel_levels[level].per.w * level_reach; // pixels
            float serves = parallel == 1 ? (screen.z <= wide ? kNever : -1.0) : wide / screen.z - ray.past;
            until = min(t_end, serves);
        }
        if (until > t) walk_level(level, t, until);
        t = max(t, until);
    }
}
)";

} // namespace heddle::viewer
