#pragma once

#include <string_view>

namespace heddle::raster {

/// GLSL: the lattice, and the bricks of 8 x 8 x 8 voxels that the segment between two slices may
/// touch. Indices are relative to the origin. Needs kSpanGlsl.
inline constexpr std::string_view kBrickGlsl = R"(
uniform ivec3 voxel_lo;    // [lo, hi)
uniform ivec3 voxel_hi;
uniform ivec3 brick_lo;
uniform ivec3 brick_count;
uniform vec3 edge;         // of a subvoxel, units
uniform int subvoxels;     // per voxel axis

uint brick_number(ivec3 brick) {
    ivec3 b = brick - brick_lo;
    return (uint(b.x) * uint(brick_count.y) + uint(b.y)) * uint(brick_count.z) + uint(b.z);
}

struct BrickBox { ivec3 lo, hi; vec3 middle; float radius; }; // bricks [lo, hi]

BrickBox bricks_of(Slice a, Slice b) {
    float reach = reach_of(a, b);
    float far = length(vec2(reach, half_length(a, b, reach))) + 0.5;
    vec3 middle = 0.5 * (a.center + b.center);
    vec3 size = edge * float(8 * subvoxels);
    ivec3 last = brick_lo + brick_count - 1;
    ivec3 lo = clamp(ivec3(floor((middle - far) / size)), brick_lo, last + 1);
    ivec3 hi = clamp(ivec3(floor((middle + far) / size)), brick_lo - 1, last);
    return BrickBox(lo, hi, middle, far);
}

bool touches(BrickBox box, ivec3 brick) {
    vec3 size = edge * float(8 * subvoxels);
    vec3 corner = vec3(brick) * size;
    vec3 gap = max(max(corner - box.middle, box.middle - (corner + size)), vec3(0.0));
    return dot(gap, gap) <= box.radius * box.radius;
}
)";

/// GLSL, one slice per item: sets the bit of each brick that the segment after it may touch.
inline constexpr std::string_view kMarkGlsl = R"(
layout(std430, binding = 1) buffer Marks { uint marks[]; };
uniform uint slice_count;

void main() {
    if (item() + 1u >= slice_count || (slices[item()].flags & kLastOfYarn) != 0u) return;
    BrickBox box = bricks_of(slices[item()], slices[item() + 1u]);
    for (int x = box.lo.x; x <= box.hi.x; ++x) {
        for (int y = box.lo.y; y <= box.hi.y; ++y) {
            for (int z = box.lo.z; z <= box.hi.z; ++z) {
                if (!touches(box, ivec3(x, y, z))) continue;
                uint number = brick_number(ivec3(x, y, z));
                atomicOr(marks[number >> 5], 1u << (number & 31u));
            }
        }
    }
}
)";

/// GLSL, compute: the number of invocations that share a segment of a list. 8 are the fastest,
/// since this is the vector width of the software driver. Of 32, most would have no pixel of a
/// small segment.
inline constexpr std::string_view kSegmentLanesGlsl = R"(
const uint kSegmentLanes = 8u;
)";

/// GLSL, one slice per item: lists the slices whose segment may touch a brick of the batch, for an
/// indirect draw of four corners each or for groups of kSegmentLanes invocations each. Needs
/// kSegmentLanesGlsl.
inline constexpr std::string_view kListGlsl = R"(
layout(std430, binding = 1) readonly buffer Slots { uint slot_of[]; };
layout(std430, binding = 2) writeonly buffer List { uint list[]; };
layout(std430, binding = 3) buffer Draw {
    uint corners; uint listed; uint first; uint base;
    uint groups_x; uint groups_y; uint groups_z;
};
uniform uint slice_count;
const uint kGroupsAcross = 32768u; // every driver allows 65535 along an axis

void add_to_list(uint number) {
    uint rank = atomicAdd(listed, 1u);
    list[rank] = number;
    uint group = rank * kSegmentLanes / gl_WorkGroupSize.x;
    atomicMax(groups_x, min(group + 1u, kGroupsAcross));
    atomicMax(groups_y, group / kGroupsAcross + 1u);
}

bool wanted(BrickBox box) {
    for (int x = box.lo.x; x <= box.hi.x; ++x) {
        for (int y = box.lo.y; y <= box.hi.y; ++y) {
            for (int z = box.lo.z; z <= box.hi.z; ++z) {
                ivec3 brick = ivec3(x, y, z);
                if (touches(box, brick) && slot_of[brick_number(brick)] != 0u) return true;
            }
        }
    }
    return false;
}

void main() {
    if (item() + 1u >= slice_count || (slices[item()].flags & kLastOfYarn) != 0u) return;
    if (wanted(bricks_of(slices[item()], slices[item() + 1u]))) add_to_list(item());
}
)";

} // namespace heddle::raster
