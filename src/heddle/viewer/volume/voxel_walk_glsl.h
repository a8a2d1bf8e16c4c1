#pragma once

#include <heddle/preview/sheet.h>
#include <heddle/viewer/volume/glsl_constant.h>

#include <string>
#include <string_view>

namespace heddle::viewer {

/// GLSL: a camera whose rays start close to the voxels, so that a distant eye does not cost
/// precision.
inline constexpr std::string_view kVoxelEyeGlsl = R"(
uniform vec3 screen; // width and height, pixels; width of a pixel: scene units; perspective: at 1
uniform int parallel;         // 1: rays are parallel
uniform vec3 right, up, away; // axes, unit
uniform vec3 start;           // start of the middle ray, relative to voxel_middle
uniform float near;           // distance from the eye to it

struct VoxelRay {
    vec3 from;  // relative to voxel_middle
    vec3 way;   // unit
    float past; // distance from the eye to `from`
};

VoxelRay voxel_ray(vec2 at) {
    vec2 p = (at - 0.5 * screen.xy) * screen.z;
    vec3 aside = p.x * right + p.y * up;
    if (parallel == 1) return VoxelRay(start + aside, away, 0.0);
    float slant = length(away + aside);
    return VoxelRay(start + near * aside, (away + aside) / slant, near * slant);
}

float pixel_width(VoxelRay ray, float t) {
    return parallel == 1 ? screen.z : screen.z * (ray.past + t);
}
)";

/// GLSL, fragment: a ray through occupied leaves and their voxels, front to back, with the opacity
/// of preview.cpp. Needs kVoxelTableGlsl, kVoxelEyeGlsl, a constant `white` (1: `white_block` is
/// solid) and these two functions. They are called for each voxel that blocks light, `hidden` of
/// the light that entered the scene, and at the end of each clump of voxels:
///     void meet(int number, int level, ivec3 at, float hidden, float t);
///     void leave_clump(int level);
inline const std::string kVoxelWalkGlsl = str("\n",
                                              glsl_constant("kOpaque", preview::kOpaque),
                                              glsl_constant("kFlatWidth", preview::kFlatWidth),
                                              glsl_constant("kClosing", preview::kClosing),
                                              glsl_constant("kSheetGap", preview::kSheetGap),
                                              R"(
uniform int level_first, level_last; // range of levels that are used
uniform float level_reach;           // a level is used for pixels up to this many of its edges wide
uniform vec3 box_lo, box_hi;         // of all voxels, relative to voxel_middle
uniform float density_scale;
uniform ivec3 white_block;

void meet(int number, int level, ivec3 at, float hidden, float t);
void leave_clump(int level);

const float kClumpGap = 4.0;   // voxels between two clumps
const float kClumpMost = 16.0; // greatest length of a clump, voxels
const float kNever = 1e30;

VoxelRay ray;
float through;    // transmittance
float sheet_end;  // t where a flat surface was last hit
float sheet_left; // its transmittance so far

// Of the current level, in its voxels, relative to the corner of its table.
ivec3 table_lo, table_hi; // voxels, inclusive
vec3 origin;              // origin of the ray
vec3 weight;              // direction of the ray: voxels per unit of t
vec3 per;                 // units of t per voxel
float sheet_gap;          // largest gap in a flat surface, scene units

// The block of a voxel.
ivec3 block_of(int level, ivec3 at) {
    ivec4 corner = voxel_levels[level].corner;
    ivec3 i = at + corner.xyz;
    return corner.w <= 5 ? i >> (5 - corner.w) : i << (corner.w - 5);
}

// The opacity of a voxel of a flat surface, as in preview.cpp.
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
    } else if ((flags & 8u) == 0u && int(depths >> 24) < kFlatWidth) {
        part = hidden_by_sheet(k, flags, t, leave);
    } else {
        part = 1.0 - exp(-length(k * weight) * (leave - t));
    }
    float hidden = through * part;
    meet(number, level, at, hidden, t);
    through -= hidden;
}

// The part of a ray inside a box.
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

// The state of a ray in a level: the voxel it is in, or enters next, and the t of its entry.
struct Walk {
    ivec3 at;
    float t;
    bool inside; // inside the table, and before the end
    ivec3 known; // the leaf whose table entries are loaded
    int cell;
    int leaf;
};

struct Found { int number; ivec3 at; float enter; float leave; }; // a voxel; number -1: none

Walk start_level(int level, float t, inout float t_end) {
    origin = ray.from * voxel_levels[level].per.xyz + voxel_levels[level].shift.xyz;
    weight = ray.way * voxel_levels[level].per.xyz;
    per = vec3(1.0) / mix(weight, vec3(1.0), equal(weight, vec3(0.0)));
    sheet_gap = kSheetGap * voxel_levels[level].shift.w;
    table_lo = voxel_levels[level].lo.xyz * 8;
    table_hi = voxel_levels[level].hi.xyz * 8 + 7;
    vec2 range = clip(origin, weight, vec3(table_lo), vec3(table_hi + 1), vec2(t, t_end));
    t_end = range.y;
    ivec3 at = clamp(ivec3(floor(origin + weight * range.x)), table_lo, table_hi);
    return Walk(at, range.x, range.x < range.y, (at >> 3) - 1, -1, -1);
}

// Steps through the voxel, or the empty leaf or cell, that the ray is in, to the next one.
Found step_on(inout Walk w, int level, float t_end) {
    if (any(notEqual(w.at >> 3, w.known))) {
        w.known = w.at >> 3;
        w.cell = voxel_cell(level, w.at >> kVoxelCellShift);
        w.leaf = w.cell < 0 ? -1 : voxel_leaf(w.cell, w.known);
    }
    int size = w.cell < 0 ? kVoxelCellShift : w.leaf < 0 ? 3 : 0; // log2 of the cube's edge
    ivec3 first = (w.at >> size) << size;
    ivec3 last = first + ((1 << size) - 1);
    bvec3 rises = greaterThan(weight, vec3(0.0));
    ivec3 behind = mix(first - 1, last + 1, rises);
    vec3 next = (vec3(mix(first, behind, rises)) - origin) * per;
    next = mix(next, vec3(kNever), equal(weight, vec3(0.0)));
    float leave = min(min(next.x, min(next.y, next.z)), t_end);
    Found found = Found(-1, w.at, w.t, leave);
    if (w.leaf >= 0 && leave > w.t) found.number = voxel_of_leaf(w.leaf, w.at & 7);
    int axis = next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
    ivec3 beside = clamp(ivec3(floor(origin + weight * leave)), first, last);
    w.at = mix(beside, behind, equal(ivec3(0, 1, 2), ivec3(axis)));
    w.t = max(w.t, leave);
    w.inside = w.t < t_end && all(greaterThanEqual(w.at, table_lo)) &&
               all(lessThanEqual(w.at, table_hi));
    return found;
}

// One loop over empty cells, leaves or voxels, within one over the voxels of a clump, within one
// over clumps. A software driver executes guarded branches for all its pixels, taken or not, and
// each loop at least once: with separate loops for cells, leaves and voxels it takes twice as long.
void walk_level(int level, float t, float t_end) {
    Walk w = start_level(level, t, t_end);
    float gap = kClumpGap * voxel_levels[level].per.w;
    float most = kClumpMost * voxel_levels[level].per.w;
    while (w.inside && through > kOpaque) {
        float first_enter = kNever; // entry into the first voxel of the clump
        float last_leave = kNever;
        bool clump = true;
        while (clump) {
            Found found = Found(-1, w.at, w.t, w.t);
            while (w.inside && found.number < 0 && through > kOpaque && w.t - last_leave <= gap) {
                found = step_on(w, level, t_end);
            }
            if (found.number >= 0) {
                cross_voxel(found.number, level, found.at, found.enter, found.leave);
                first_enter = min(first_enter, found.enter);
                last_leave = found.leave;
            }
            clump = found.number >= 0 && found.leave - first_enter < most;
        }
        leave_clump(level);
    }
}

// The t at which a pixel becomes wider than a level's voxels.
float end_of(int level) {
    float wide = voxel_levels[level].per.w * level_reach;
    if (parallel == 1) return screen.z <= wide ? kNever : -kNever;
    return wide / screen.z - ray.past;
}

// Traces the ray from its start to t_end.
void walk_ray(float t_end) {
    through = 1.0;
    sheet_end = -kNever;
    sheet_left = 1.0;
    vec2 range = clip(ray.from, ray.way, box_lo, box_hi, vec2(0.0, t_end));
    float t = range.x;
    t_end = range.y;
    int level = level_first;
    while (t < t_end && through > kOpaque) {
        while (level < level_last && end_of(level) <= t) ++level;
        float until = level < level_last ? min(t_end, end_of(level)) : t_end;
        walk_level(level, t, until);
        t = until;
    }
}
)");

} // namespace heddle::viewer
