#pragma once

#include <heddle/base/platform.h>

#include <cstdint>

// Which of a voxel's 4 x 4 x 4 cells contain geometry: bit (x 4 + y) 4 + z stands for cell
// (x, y, z).

namespace heddle {

/// All cells of a voxel.
inline constexpr std::uint64_t kAllCells = ~std::uint64_t{0};

namespace detail {

/// The cells of octant (0, 0, 0): x, y and z below 2.
inline constexpr std::uint64_t kFirstOctant = 0x00330033;

/// Returns the distance of an octant's cells to those of octant 0 in the word.
/// @param octant  4 x + 2 y + z
[[nodiscard]] HEDDLE_HD constexpr int shift_of_octant(int octant) {
    return (octant >> 2) * 32 + (octant >> 1 & 1) * 8 + (octant & 1) * 2;
}

/// Returns the cells of 8 x 8 x 8 subvoxels, by pairs along each axis.
[[nodiscard]] HEDDLE_HD constexpr std::uint64_t pair_subvoxels(const std::uint64_t* sub) {
    std::uint64_t cells = 0;
    for (int x = 0; x < 4; ++x) {
        std::uint64_t word = sub[2 * x] | sub[2 * x + 1]; // bit 8 y + z
        word |= word >> 8;
        word |= word >> 1;
        word &= 0x0055005500550055; // y and z are even
        word = (word | word >> 1) & 0x0033003300330033;
        word = (word | word >> 2) & 0x000f000f000f000f;
        word = (word | word >> 12) & 0x000000ff000000ff;
        word = (word | word >> 24) & 0xffff;
        cells |= word << (16 * x);
    }
    return cells;
}

} // namespace detail

/// Returns the cells of a voxel of level 0 that contain an occupied subvoxel. With one or two
/// subvoxels per axis, a subvoxel fills all cells that it spans.
/// @param sub  VoxelSums::sub
/// @param n    subvoxels per axis: 1, 2, 4 or 8
[[nodiscard]] HEDDLE_HD constexpr std::uint64_t cells_of_subvoxels(const std::uint64_t* sub,
                                                                   int n) {
    if (n == 8) return detail::pair_subvoxels(sub);
    if (n == 4) return sub[0];
    if (n == 1) return (sub[0] & 1) != 0 ? kAllCells : 0;
    std::uint64_t cells = 0;
    for (int octant = 0; octant < 8; ++octant) {
        if ((sub[0] >> octant & 1) == 0) continue;
        cells |= detail::kFirstOctant << detail::shift_of_octant(octant);
    }
    return cells;
}

/// Returns the cells of a parent that contain a set cell of one of its children. The parent's cells
/// are those of its children, joined by OR.
/// @param octant  position of the child: 4 x + 2 y + z
[[nodiscard]] HEDDLE_HD constexpr std::uint64_t cells_in_parent(std::uint64_t child, int octant) {
    std::uint64_t pairs = child | child >> 16;
    pairs |= pairs >> 4;
    pairs |= pairs >> 1;
    pairs &= 0x0000050500000505; // x, y and z are even
    pairs = (pairs | pairs >> 1) & 0x0000030300000303;
    pairs = (pairs | pairs >> 4) & 0x0000003300000033;
    pairs = (pairs | pairs >> 16) & detail::kFirstOctant;
    return pairs << detail::shift_of_octant(octant);
}

} // namespace heddle
