#pragma once

#include <cstdint>
#include <string>

namespace heddle {

/// The grids of a Heddle .vdb; docs/format.md says what each holds.
enum class GridKind : std::uint8_t {
    Density,  ///< float
    Tangent,  ///< vec3s
    Normal,   ///< vec3s
    Coverage, ///< int64
    Lobe,     ///< int64, one grid per lobe
    Albedo,   ///< int32, one grid per lobe
    Surface,  ///< int32, one grid per lobe
    Aniso     ///< int64, one grid per lobe
};

/// Name of a grid in the file: "density", "lobe_1"; from level 1 on "lobe_1_level_2".
/// @param lobe   from 0; ignored where a voxel has one value
/// @param level  from 0, the finest
[[nodiscard]] std::string grid_name(GridKind kind, int lobe = 0, int level = 0);

/// True for the kinds that have one grid per lobe.
[[nodiscard]] constexpr bool is_per_lobe(GridKind kind) {
    return kind >= GridKind::Lobe;
}

} // namespace heddle
