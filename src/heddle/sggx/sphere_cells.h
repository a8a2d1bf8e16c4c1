#pragma once

#include <heddle/base/vec.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace heddle {

// Cells of equal area on the sphere, for comparing distributions of directions: HEALPix in ring
// order [Gorski 2005, "HEALPix"]. Only for measuring, on the host: the last bit of libm's atan2 may
// differ between machines, which moves directions that are on the edge of a cell.

inline constexpr int kSphereCellSide = 8; ///< N_side
inline constexpr int kSphereCells = 12 * kSphereCellSide * kSphereCellSide;

namespace detail {

/// The cell at height `z`, |z| <= 1, and longitude `quarters` in quarter turns, in [0, 4).
/// @param xx_yy  1 - z^2, precise near the poles
[[nodiscard]] inline int sphere_cell_at(double z, double xx_yy, double quarters) {
    constexpr int n = kSphereCellSide;
    const double height = std::fabs(z);
    if (height <= 2.0 / 3.0) { // rows of 4 n squares on edge, each shifted by half a square
        const double along = n * (0.5 + quarters);
        const double across = n * 0.75 * z;
        const int rising = static_cast<int>(along - across);
        const int falling = static_cast<int>(along + across);
        const int ring = n + 1 + rising - falling; // 1 .. 2 n + 1, from the north
        const int shift = 1 - (ring & 1);
        const int column = (rising + falling - n + shift + 1) / 2 % (4 * n);
        return 2 * n * (n - 1) + (ring - 1) * 4 * n + column;
    }
    const double part = quarters - std::floor(quarters);
    const double reach = n * std::sqrt(3.0 * xx_yy / (1.0 + height)); // 3 (1 - |z|)
    const int ring =
        std::min(n, 1 + static_cast<int>(part * reach) + static_cast<int>((1.0 - part) * reach));
    const int column = static_cast<int>(quarters * ring) % (4 * ring);
    return z > 0.0 ? 2 * ring * (ring - 1) + column : kSphereCells - 2 * ring * (ring + 1) + column;
}

} // namespace detail

/// The cells of a direction and of its opposite.
struct CellPair {
    std::uint16_t cell = 0;
    std::uint16_t opposite = 0;
};

/// The cells that contain `d` and -d, 0 .. kSphereCells - 1, from north to south, then eastwards.
///
/// @param d  not 0; any length
[[nodiscard]] inline CellPair sphere_cells_of(Vec3d d) {
    const double flat = d.x * d.x + d.y * d.y;
    const double inverse = 1.0 / (flat + d.z * d.z);
    const double z = std::clamp(d.z * std::sqrt(inverse), -1.0, 1.0);
    constexpr double kQuartersPerRadian = 0.6366197723675814;
    const double turned = std::atan2(d.y, d.x) * kQuartersPerRadian; // [-2, 2]
    const double quarters = turned < 0.0 ? turned + 4.0 : turned;
    const double opposite = turned < 0.0 ? turned + 2.0 : turned >= 2.0 ? 0.0 : turned + 2.0;
    const auto at = [&](double height, double longitude) {
        return static_cast<std::uint16_t>(
            detail::sphere_cell_at(height, flat * inverse, longitude < 4.0 ? longitude : 0.0));
    };
    return {at(z, quarters), at(-z, opposite)};
}

/// The centres of the 12 side^2 cells of the sphere, in ring order. With side = 8 k there are k^2
/// centres inside each cell of sphere_cells_of.
///
/// @param side  N_side, >= 1
[[nodiscard]] inline std::vector<Vec3d> sphere_cell_centers(int side) {
    std::vector<Vec3d> centers;
    for (int ring = 1; ring < 4 * side; ++ring) {
        const int from_pole = std::min(ring, 4 * side - ring);
        const bool cap = from_pole < side;
        const int count = 4 * std::min(from_pole, side);
        const double height = cap ? 1.0 - from_pole * from_pole / (3.0 * side * side)
                                  : (2.0 * side - from_pole) * 2.0 / (3.0 * side);
        const double z = ring <= 2 * side ? height : -height;
        const double shift = cap || (from_pole - side) % 2 == 0 ? 0.5 : 0.0;
        for (int column = 0; column < count; ++column) {
            const double phi = 6.283185307179586 * (column + shift) / count;
            const double r = std::sqrt(1.0 - z * z);
            centers.push_back({r * std::cos(phi), r * std::sin(phi), z});
        }
    }
    return centers;
}

} // namespace heddle
