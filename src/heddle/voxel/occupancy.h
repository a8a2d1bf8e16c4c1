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

namespace detail {

/// The columns along one axis in the 4 x 4 cells of a face; cell (a, b) is bit 4 a + b.
struct FaceCells {
    std::uint64_t some = 0; ///< a column of the cell is covered
    std::uint64_t half = 0; ///< at least half of the cell's columns are
};

/// Returns 4 x 4 bits, of which bit 4 b + a becomes bit 4 a + b.
[[nodiscard]] HEDDLE_HD constexpr std::uint64_t transpose(std::uint64_t bits) {
    std::uint64_t swap = (bits ^ bits >> 3) & 0x0a0a;
    bits ^= swap ^ swap << 3;
    swap = (bits ^ bits >> 6) & 0x00cc;
    return bits ^ swap ^ swap << 6;
}

/// Returns 4 x 4 bits from those at the even (a, b) of 8 x 8 bits 8 b + a.
[[nodiscard]] HEDDLE_HD constexpr std::uint64_t compress_even(std::uint64_t word) {
    word = (word | word >> 1) & 0x0033003300330033;
    word = (word | word >> 2) & 0x000f000f000f000f;
    word = (word | word >> 12) & 0x000000ff000000ff;
    return (word | word >> 24) & 0xffff;
}

/// @param columns  VoxelSums::column along the axis
/// @param n        subvoxels per axis: 1, 2, 4 or 8
[[nodiscard]] HEDDLE_HD constexpr FaceCells face_cells(std::uint64_t columns, int n) {
    if (n == 8) {
        constexpr std::uint64_t kEven = 0x0055005500550055;
        const std::uint64_t p = columns & kEven, q = columns >> 1 & kEven;
        const std::uint64_t r = columns >> 8 & kEven, s = columns >> 9 & kEven;
        const std::uint64_t two = (p & q) | (r & s) | ((p | q) & (r | s));
        return {transpose(compress_even(p | q | r | s)), transpose(compress_even(two))};
    }
    std::uint64_t bits = columns; // bit 4 b + a
    if (n == 1) bits = columns != 0 ? 0xffff : 0;
    if (n == 2) {
        bits = (columns & 1) * 0x0033 | (columns >> 1 & 1) * 0x00cc | (columns >> 2 & 1) * 0x3300 |
               (columns >> 3 & 1) * 0xcc00;
    }
    return {transpose(bits), transpose(bits)};
}

/// Returns all cells behind the given cells of the face along an axis.
[[nodiscard]] HEDDLE_HD constexpr std::uint64_t cells_behind(std::uint64_t face, int axis) {
    if (axis == 0) return face * 0x0001000100010001;
    std::uint64_t cells = 0;
    for (int x = 0; x < 4; ++x) {
        const std::uint64_t row = face >> (4 * x) & 15; // along z for axis 1, along y for axis 2
        const std::uint64_t ends = (row & 1) | (row & 2) << 3 | (row & 4) << 6 | (row & 8) << 9;
        cells |= (axis == 1 ? row * 0x1111 : ends * 0xf) << (16 * x);
    }
    return cells;
}

/// Returns the cells of the face along an axis that have a set cell behind them.
[[nodiscard]] HEDDLE_HD constexpr std::uint64_t face_of_cells(std::uint64_t cells, int axis) {
    if (axis == 0) return (cells | cells >> 16 | cells >> 32 | cells >> 48) & 0xffff;
    std::uint64_t face = 0;
    for (int x = 0; x < 4; ++x) {
        std::uint64_t block = cells >> (16 * x) & 0xffff; // bit 4 y + z
        if (axis == 2) block = transpose(block);
        face |= ((block | block >> 4 | block >> 8 | block >> 12) & 15) << (4 * x);
    }
    return face;
}

} // namespace detail

/// Returns the cells of a voxel of level 0 that contain geometry: those with an occupied subvoxel,
/// and, since thin geometry passes between the centre lines along z that occupy subvoxels, cells
/// that only columns see. Where a face's cell is at least half covered and nothing is behind it,
/// the cells behind it are set that are behind covered cells of the other faces too.
/// @param sub      VoxelSums::sub
/// @param columns  VoxelSums::column
/// @param n        subvoxels per axis: 1, 2, 4 or 8
[[nodiscard]] HEDDLE_HD constexpr std::uint64_t
cells_of_voxel(const std::uint64_t* sub, const std::uint64_t* columns, int n) {
    const std::uint64_t cells = cells_of_subvoxels(sub, n);
    std::uint64_t holes = 0;
    std::uint64_t seen = kAllCells;
    for (int axis = 0; axis < 3; ++axis) {
        const detail::FaceCells face = detail::face_cells(columns[axis], n);
        holes |= detail::cells_behind(face.half & ~detail::face_of_cells(cells, axis), axis);
        if (face.some != 0) seen &= detail::cells_behind(face.some, axis);
    }
    return cells | (holes & seen);
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
