#pragma once

#include <heddle/base/vec.h>
#include <heddle/voxel/voxel_level.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace heddle {

/// What a ray needs to know of a voxel of surfaces: a sheet at an unknown height in its plane slab,
/// and the rest, which is anywhere in the voxel.
struct SheetVoxel {
    std::array<std::int16_t, 3> normal{}; ///< of the slab, 32767 = 1
    std::uint8_t lo = 0;                  ///< PlaneSlab
    std::uint8_t hi = 0;
    /// -ln(1 - p) in kDepthUnit, where p is the probability that the sheet is where a ray crosses
    /// it; kOpaqueSheet: 1
    std::uint16_t depth = 0;
    std::array<std::uint16_t, 3> rest{}; ///< optical depth along each axis without the sheet
};
static_assert(sizeof(SheetVoxel) == 16);

inline constexpr std::uint16_t kOpaqueSheet = 65535;

/// A voxel as make_sheet() reads it.
struct SheetSource {
    PlaneSlab slab;
    std::array<double, 3> covered; ///< coverage along the axes, 0 to 1
};

/// Splits the coverage of a voxel between its sheet and the rest.
[[nodiscard]] SheetVoxel make_sheet(const Lattice& lattice, const SheetSource& source);

namespace detail {

/// Returns, per axis, the coverage of a sheet whose height is uniform in [lo, hi]: the area of the
/// plane's part in the voxel, projected along the axis onto the voxel's face of area 1.
/// @param gradient  change of the height along each edge of the voxel
/// @param lo, hi    heights from the voxel's center, lo < hi
[[nodiscard]] std::array<double, 3> project_sheet(Vec3d gradient, double lo, double hi);

/// Returns, per axis, the extents of the border that a plane's projection has within the voxel's
/// face, in units of the face's edges.
[[nodiscard]] std::array<double, 3> border_of_sheet(Vec3d gradient, double height);

} // namespace detail

} // namespace heddle
