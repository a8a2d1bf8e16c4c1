#pragma once

#include <array>
#include <bit>
#include <cstdint>

// The 4 x 4 x 4 cells of a voxel as 64 bits: bit (x * 4 + y) * 4 + z is set where cell (x, y, z)
// contains geometry.

namespace heddle {

/// Edge of a cell: 1 / kCells of the voxel's.
inline constexpr int kCells = 4;

/// The 16 columns of cells along one axis, sorted by how many of their cells are set: [n] has one
/// bit for each column with n set cells. Two voxels have the same bit for the same column.
using CellColumns = std::array<std::uint64_t, kCells + 1>;

/// @param cells  the voxel's cells
/// @param axis   0 to 2
[[nodiscard]] inline CellColumns sort_columns(std::uint64_t cells, int axis) {
    constexpr std::array<std::uint64_t, 3> kSlice{0xffff, 0x000f000f000f000f, 0x1111111111111111};
    constexpr std::array<int, 3> kStep{16, 4, 1};
    const std::uint64_t slice = kSlice[static_cast<std::size_t>(axis)];
    const int step = kStep[static_cast<std::size_t>(axis)];
    const std::uint64_t a = cells & slice;
    const std::uint64_t b = cells >> step & slice;
    const std::uint64_t c = cells >> 2 * step & slice;
    const std::uint64_t d = cells >> 3 * step & slice;
    const std::uint64_t carry = (a ^ b) & (c ^ d);
    const std::uint64_t ones = a ^ b ^ c ^ d; // the count of each column in binary
    const std::uint64_t twos = (a & b) ^ (c & d) ^ carry;
    const std::uint64_t fours = a & b & c & d;
    return {slice & ~(ones | twos | fours), ones & ~twos, twos & ~ones, ones & twos, fours};
}

} // namespace heddle
