#pragma once

#include <heddle/render/volume/cell_columns.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace heddle {

/// The extinction of a voxel's set cells along one axis, in 16 bits.
///
/// The upper 10 bits are the logarithm of the optical depth per voxel edge, from 2^-10 to 2^6 in
/// steps of 1.1 %; 0: none. The lower 6 bits are the part of it that is left for a ray that passes
/// straight through a row of voxels, in units of 1/63.
struct CellExtinction {
    std::uint16_t bits = 0;
};

/// The largest extinction: a cell is never passed.
inline constexpr float kMostCellExtinction = 64.0f;

/// @param extinction  optical depth per voxel edge, >= 0
/// @param in_row      in (0, 1]
[[nodiscard]] CellExtinction pack_extinction(float extinction, float in_row);

namespace detail {

/// Extinction by the upper 10 bits.
[[nodiscard]] const std::array<float, 1024>& extinction_table();

} // namespace detail

/// Returns the optical depth per voxel edge.
[[nodiscard]] inline float unpack_extinction(CellExtinction from) {
    return detail::extinction_table()[from.bits >> 6];
}
[[nodiscard]] inline float unpack_in_row(CellExtinction from) {
    return static_cast<float>(from.bits & 63u) * (1.0f / 63.0f);
}

/// Returns the extinction sigma of a voxel's set cells, for which the mean over the columns of
/// 1 - exp(-sigma n / 4) is the coverage; n is the number of set cells in a column. If the set
/// columns alone cover no more than that, kMostCellExtinction.
[[nodiscard]] float fit_extinction(const CellColumns& columns, float coverage);

/// Returns the coverage that an extinction gives: the inverse of fit_extinction().
[[nodiscard]] float coverage_of_cells(const CellColumns& columns, float extinction);

/// One of two voxels behind each other.
struct RowVoxel {
    CellColumns columns;
    float extinction = 0.0f;
    float coverage = 0.0f;
};

/// Returns the factor of both extinctions that gives the true coverage of the pair, at most 1.
///
/// Columns of the two voxels cover parts of each other, in cells of which only a part is filled.
/// Independent cells would cover more together.
/// @param correlation  VoxelBlock::correlation of the face between them, 0 to 1
[[nodiscard]] float fit_pair(const RowVoxel& first, const RowVoxel& second, float correlation);

} // namespace heddle
