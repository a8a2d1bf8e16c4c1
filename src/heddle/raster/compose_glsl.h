#pragma once

#include <string_view>

namespace heddle::raster {

/// GLSL for `last`, `average` and `max`: the slice's alpha at subvoxels, as one density per voxel.
inline constexpr std::string_view kComposeGlsl = R"(
uniform int policy;       // 0 last, 1 average, 2 max
uniform int pick;         // for `last`: pass 0 finds the last fragment, pass 1 stores its alpha
uniform uint first_slice; // number of the buffer's first slice among all slices

// Fragments of a slice are ordered by their subvoxel.
uint order_of(ivec3 at) {
    ivec3 sub = at & (subvoxels - 1);
    return ((first_slice + segment) << 9 | uint((sub.x * 8 + sub.y) * 8 + sub.z)) + 1u;
}

void compose(uint words, uint alpha, ivec3 at) {
    if (policy == 0 && pick == 0) atomicMax(pool[words], order_of(at));
    if (policy == 0 && pick == 1 && pool[words] == order_of(at)) atomicMax(pool[words + 1u], alpha);
    if (policy == 1) {
        atomicAdd(pool[words], alpha);
        atomicAdd(pool[words + 1u], 1u);
    }
    if (policy == 2) atomicMax(pool[words], alpha);
}

void draw_pixel(ivec2 pixel) {
    vec2 range = start_column(pixel);
    if (!(range.x < range.y)) return;
    int shift = subvoxels == 8 ? 3 : subvoxels == 4 ? 2 : subvoxels == 2 ? 1 : 0;
    ivec3 at = axis == 0   ? ivec3(0, pixel)
               : axis == 1 ? ivec3(pixel.x, 0, pixel.y)
                           : ivec3(pixel, 0);
    int first = int(floor(range.x / edge[axis]));
    int last = int(ceil(range.y / edge[axis])) - 1;
    for (int k = first; k <= last; ++k) {
        float lo = max(range.x, float(k) * edge[axis]);
        float hi = min(range.y, float(k + 1) * edge[axis]);
        if (!(lo < hi)) continue;
        Local l = local_at(0.5 * (lo + hi));
        if (max(abs(l.at.x), abs(l.at.y)) > sizes.x) continue;
        float alpha = textureLod(section_color, layer_point(l.at), 0.0).a;
        uint level = uint(round(255.0 * alpha));
        if (level == 0u && policy != 1) continue;
        at[axis] = k;
        uint words = words_of(at >> shift);
        if (words == kNoVoxel) continue;
        compose(words, level, at);
        if (level == 0u || pick == 1) continue;
        add_direction(words, direction_of(l), weight_of((hi - lo) * alpha, l.scale), color_of(l));
    }
}
)";

} // namespace heddle::raster
