#pragma once

#include <cstdint>
#include <string>

namespace heddle {

/// The grids of a Heddle .vdb; docs/format.md describes them.
enum class GridKind : std::uint8_t {
    Density,       ///< float
    Tangent,       ///< vec3s
    Normal,        ///< vec3s
    Coverage,      ///< int64
    Columns,       ///< int64, one grid per axis
    Footprint,     ///< int64: of 4 x 4 cells, three axes in one
    FootprintAxis, ///< int64: of 8 x 8 cells, one grid per axis
    Occupancy,     ///< int64
    Correlation,   ///< int32
    Slab,          ///< int32
    Merge,         ///< int32
    Lobe,          ///< int64, one grid per lobe
    Albedo,        ///< int32, one grid per lobe
    Surface,       ///< int32, one grid per lobe
    Aniso,         ///< int64, one grid per lobe
    Sums           ///< int64, 7 or 19 grids per lobe
};

/// The name of a grid in the file: "density", "columns_z", "lobe_1", "sums_1_6"; from level 1 on
/// with a suffix: "lobe_1_level_2".
/// @param index  axis or lobe, from 0; ignored if a voxel has one value
/// @param level  from 0, the finest
/// @param part   for GridKind::Sums: which of a lobe's sums, from 0
[[nodiscard]] std::string grid_name(GridKind kind, int index = 0, int level = 0, int part = 0);

/// A grid's name without its level, and the level.
struct GridStem {
    std::string stem; ///< "lobe_1"
    int level = 0;    ///< -1: the suffix has a number, but none that grid_name writes
};

/// Splits a name of grid_name into stem and level.
[[nodiscard]] GridStem split_grid_name(const std::string& name);

} // namespace heddle
