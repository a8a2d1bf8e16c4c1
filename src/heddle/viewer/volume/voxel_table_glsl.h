#pragma once

#include <heddle/preview/preview_volume.h>
#include <heddle/viewer/volume/glsl_constant.h>
#include <heddle/viewer/volume/measure_voxels.h>

#include <string>

namespace heddle::viewer {

/// GLSL, any stage: voxels in the driver's memory, as VoxelTables::bind binds them: storage blocks
/// 8 to 13, uniform block 8. Levels are numbered as in the input of VoxelTables; the finest that is
/// stored is voxel_range.x, the coarsest voxel_range.y.
///
/// `bool voxel_at(vec3 point, int level, out vec3 axis, out float density)`: whether there is a
/// voxel at a point in scene units. `axis` is the direction of its heaviest lobe (a fiber's tangent
/// or a surface's normal; unit, with arbitrary sign), `density` the mean of its coverage over the
/// three axes, in [0, 127/128]. For a level that is not stored, the nearest one is used.
inline const std::string kVoxelTableGlsl =
    str("\n",
        glsl_constant("kVoxelLevels", kMaxVoxelLevels),
        glsl_constant("kVoxelCellShift", preview::PreviewVolume::Table::kTileShift),
        glsl_constant("kVoxelLeafWords", static_cast<int>(kLeafWords)),
        glsl_constant("kVoxelMaxDepth", preview::kMaxDepth),
        R"(
struct VoxelLevelTables {
    vec4 per;     // voxels per scene unit; w: longest edge, scene units
    vec4 shift;   // voxel_middle from the table's corner, voxels; w: shortest edge, scene units
    ivec4 corner; // first voxel index of the table; w: doublings of the finest edges
    ivec4 cells;  // of 16^3 leaves in the table; w: its first in voxel_cells
    ivec4 lo;     // first leaf, from the corner
    ivec4 hi;     // last leaf, inclusive
};
layout(std140, binding = 8) uniform VoxelLevels {
    vec4 voxel_middle; // scene units
    ivec4 voxel_range; // finest and coarsest level
    VoxelLevelTables voxel_levels[kVoxelLevels];
};
layout(std430, binding = 8) readonly buffer VoxelCells { int voxel_cells[]; }; // -1: empty
layout(std430, binding = 9) readonly buffer VoxelLeafTable { uint voxel_leaf_table[]; }; // 0: none
layout(std430, binding = 10) readonly buffer VoxelLeaves { uint voxel_leaves[]; };
layout(std430, binding = 11) readonly buffer VoxelDepths { uint voxel_depths[]; }; // and width
layout(std430, binding = 12) readonly buffer VoxelColors { uint voxel_colors[]; }; // and axis x
// axis y and z, material, flags
layout(std430, binding = 13) readonly buffer VoxelAxes { uint voxel_axes[]; };

// All indices are relative to the corner of the level's table.
int voxel_cell(int level, ivec3 cell) {
    ivec4 cells = voxel_levels[level].cells;
    if (any(lessThan(cell, ivec3(0))) || any(greaterThanEqual(cell, cells.xyz))) return -1;
    return voxel_cells[cells.w + (cell.x * cells.y + cell.y) * cells.z + cell.z];
}

// The index of its first of kVoxelLeafWords words in voxel_leaves; negative: empty.
int voxel_leaf(int cell, ivec3 leaf) {
    const int bits = kVoxelCellShift - 3;
    ivec3 i = leaf & ((1 << bits) - 1);
    int slot = (((cell << bits | i.x) << bits | i.y) << bits) | i.z;
    return (int(voxel_leaf_table[slot]) - 1) * kVoxelLeafWords;
}

// Index of voxel `at` of a leaf; -1: empty.
int voxel_of_leaf(int leaf, ivec3 at) {
    int half_word = at.y >> 2;
    uint word = voxel_leaves[leaf + 2 * at.x + half_word];
    uint bit = 1u << (((at.y & 3) << 3) | at.z);
    if ((word & bit) == 0u) return -1;
    uint before = voxel_leaves[leaf + 16 + (at.x >> 1)] >> (16 * (at.x & 1)) & 0xffffu;
    int count = bitCount(word & (bit - 1u)) + int(before + voxel_leaves[leaf + 20]);
    return half_word == 0 ? count : count + bitCount(voxel_leaves[leaf + 2 * at.x]);
}

// Index of the voxel at a point relative to voxel_middle, scene units; -1: empty.
int voxel_at_offset(vec3 offset, int level) {
    ivec3 at = ivec3(floor(offset * voxel_levels[level].per.xyz + voxel_levels[level].shift.xyz));
    int cell = voxel_cell(level, at >> kVoxelCellShift);
    int leaf = cell < 0 ? -1 : voxel_leaf(cell, at >> 3);
    return leaf < 0 ? -1 : voxel_of_leaf(leaf, at & 7);
}

// -ln(1 - c) by axis.
vec3 voxel_depth(uint depths) { return unpackUnorm4x8(depths).xyz * kVoxelMaxDepth; }

vec3 voxel_axis(uint colors, uint axes) {
    return normalize(vec3(bitfieldExtract(int(colors), 24, 8), bitfieldExtract(int(axes), 0, 8),
                          bitfieldExtract(int(axes), 8, 8)));
}

float voxel_density(vec3 depth) { return dot(vec3(1.0) - exp(-depth), vec3(1.0 / 3.0)); }

bool voxel_at(vec3 point, int level, out vec3 axis, out float density) {
    axis = vec3(0.0);
    density = 0.0;
    int there = clamp(level, voxel_range.x, voxel_range.y);
    int number = voxel_at_offset(point - voxel_middle.xyz, there);
    if (number < 0) return false;
    axis = voxel_axis(voxel_colors[number], voxel_axes[number]);
    density = voxel_density(voxel_depth(voxel_depths[number]));
    return true;
}
)");

} // namespace heddle::viewer
