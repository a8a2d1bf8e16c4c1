#pragma once

#include <string_view>

namespace heddle::raster {

/// GLSL for `accumulate`: traces the centre ray of every column through the fibers themselves.
inline constexpr std::string_view kAccumulateGlsl = R"(
// The bit of a column along x is z n + y, along y it is z n + x, along z it is y n + x.
uint column_bit(ivec3 sub) {
    return uint(axis == 0 ? sub.z * subvoxels + sub.y
              : axis == 1 ? sub.z * subvoxels + sub.x
                          : sub.y * subvoxels + sub.x);
}

// Sets the bits of the subvoxels of a column along z whose centres lie in [from, to), which is in
// subvoxels from the voxel's corner.
void mark_subvoxels(uint words, ivec3 sub, float from, float to) {
    int first = max(int(ceil(from - 0.5)), 0);
    int last = min(int(ceil(to - 0.5)) - 1, subvoxels - 1);
    if (last < first) return;
    int bit = (sub.x * subvoxels + sub.y) * subvoxels + first;
    uint run = (1u << uint(last - first + 1)) - 1u;
    atomicOr(pool[words + 6u + uint(bit >> 5)], run << uint(bit & 31));
}

// Adds the part [from, to) of a column, which is inside a fiber, to the sums of its voxels.
void add_run(ivec2 pixel, float from, float to) {
    Local l = local_at(0.5 * (from + to));
    vec3 direction = direction_of(l);
    vec3 color = color_of(l);
    float deep = edge[axis] * float(subvoxels);
    int first = int(floor(from / deep));
    int last = int(ceil(to / deep)) - 1;
    ivec3 at = axis == 0   ? ivec3(0, pixel)
               : axis == 1 ? ivec3(pixel.x, 0, pixel.y)
                           : ivec3(pixel, 0);
    int shift = subvoxels == 8 ? 3 : subvoxels == 4 ? 2 : subvoxels == 2 ? 1 : 0;
    ivec3 sub = at & (subvoxels - 1);
    ivec3 voxel = at >> shift;
    uint bit = column_bit(sub);
    for (int v = first; v <= last; ++v) {
        voxel[axis] = v;
        uint words = words_of(voxel);
        if (words == kNoVoxel) continue;
        float lo = max(from, float(v) * deep);
        float hi = min(to, float(v + 1) * deep);
        if (!(lo < hi)) continue;
        atomicOr(pool[words + 2u * uint(axis) + (bit >> 5)], 1u << (bit & 31u));
        if (axis == 2) {
            float corner = float(v) * deep;
            mark_subvoxels(words, sub, (lo - corner) / edge.z, (hi - corner) / edge.z);
        }
        add_direction(words, direction, weight_of(hi - lo, l.scale), color);
    }
}

struct March { float t, d, last_d, last_t; }; // d: units from the surface, < 0 inside

float signed_depth(float t) {
    Local l = local_at(t);
    return distance_at(l.at) * l.scale;
}

// Advances t until d no longer has the sign of `side`. Then t is where the sign changes, or `end`.
void advance(inout March m, float side, float end, float speed, float min_step) {
    for (int i = 0; i < 1024; ++i) {
        m.last_d = m.d;
        m.last_t = m.t;
        m.t += max(abs(m.d) / speed, min_step);
        if (m.t >= end) {
            m.t = end;
            return;
        }
        m.d = signed_depth(m.t);
        if (m.d * side <= 0.0) {
            m.t = mix(m.last_t, m.t, m.last_d / (m.last_d - m.d));
            m.d = -side * 1e-6;
            return;
        }
    }
}

void draw_pixel(ivec2 pixel) {
    vec2 range = start_column(pixel);
    if (!(range.x < range.y)) return;
    // an upper bound of the ray's speed over the section
    float lean = along[axis];
    float speed = sqrt(max(1.0 - lean * lean, 0.0)) +
                  abs(tangent_a.w) / max(chord, 1e-6) * sizes.z * abs(lean) + bend + 0.02;
    float min_step = clamp(0.25 * sizes.y * center_a.w, 0.02, 0.5);
    March m = March(range.x, 0.0, 0.0, range.x);
    m.d = signed_depth(m.t);
    // one run per iteration: rays that are traced side by side wait for each other only at its end
    for (int run = 0; run < 1024 && m.t < range.y; ++run) {
        if (m.d > 0.0) advance(m, 1.0, range.y, speed, min_step);
        if (m.t >= range.y) break;
        float from = m.t;
        advance(m, -1.0, range.y, speed, min_step);
        add_run(pixel, from, m.t);
    }
}
)";

} // namespace heddle::raster
