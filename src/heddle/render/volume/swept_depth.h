#pragma once

#include <heddle/render/volume/transport.h>
#include <heddle/render/volume/traversal_level.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

// The optical depth of a ray's path through a voxel, by the voxel's footprints of 4 x 4 cells.

namespace heddle {

namespace detail {

/// The cells that a path crosses are read at this many points, evenly spaced along it.
inline constexpr int kWayPoints = 4;
/// The largest coverage of a swept cell: a few columns of a cell may be open although it is set, so
/// it is never opaque.
inline constexpr float kMostCovered = 1.0f - 1.0f / 128.0f;
/// The same in the bulk of a yarn, where other fibers close the gaps behind a column.
inline constexpr float kMostCoveredInBulk = 1.0f - 1e-4f;
/// Factor of optical depths in the bulk of a yarn: fibers are denser there than their coverage
/// indicates, because they occlude each other.
inline constexpr float kBulkDepth = 1.5f;

/// Returns, per axis, at how many points of the path the cell of that axis's footprint is set.
[[nodiscard]] inline std::array<int, 3>
count_set_cells(std::uint64_t footprints, Vec3f in, Vec3f way) {
    std::array<int, 3> set{};
    const Vec3f step = way * (4.0f / kWayPoints);
    Vec3f at = in * 4.0f + step * 0.5f;
    for (int k = 0; k < kWayPoints; ++k, at = at + step) {
        const auto cell = [](float x) { return std::clamp(static_cast<int>(x), 0, 3); };
        const int x = cell(at.x), y = cell(at.y), z = cell(at.z);
        set[0] += static_cast<int>(footprints >> (4 * z + y) & 1);
        set[1] += static_cast<int>(footprints >> (16 + 4 * x + z) & 1);
        set[2] += static_cast<int>(footprints >> (32 + 4 * y + x) & 1);
    }
    return set;
}

/// Returns the mean coverage of the cells that a path crosses. If rounding set more cells than are
/// covered, their coverage is reduced; if it set none, the voxel is taken as uniform.
/// @param depth  TraversalVoxel::depth along the axis
/// @param bits   footprint along the axis
/// @param set    number of the kWayPoints points whose cell is set
[[nodiscard]] inline float swept_coverage(std::uint16_t depth, std::uint16_t bits, int set) {
    const float covered = 1.0f - std::exp(-kDepthUnit * static_cast<float>(depth));
    if (bits == 0) return covered;
    const float share = static_cast<float>(std::popcount(bits)) * (1.0f / 16.0f);
    return static_cast<float>(set) * (1.0f / kWayPoints) * std::min(1.0f, covered / share);
}

/// Returns the optical depth of a path that spans the fraction `part` of columns of coverage
/// `swept`.
[[nodiscard]] inline float depth_of_part(float swept, float part, float many, float bulk) {
    float depth = -(1.0f - many) * std::log(1.0f - std::min(swept * part, kMostCovered));
    if (many > 0.0f) depth -= many * part * std::log(1.0f - std::min(swept, kMostCovered));
    if (bulk > 0.0f) {
        const float behind =
            -kBulkDepth * part * std::log(1.0f - std::min(swept, kMostCoveredInBulk));
        depth += bulk * (behind - depth);
    }
    return depth;
}

} // namespace detail

/// Returns the optical depths along the axes for one path through a voxel, from the cells of each
/// face that the projection of the path crosses.
///
/// A ray along an axis crosses one cell, set or not; for an oblique ray the coverage c is the
/// fraction of set cells among those that it crosses. A covered column is blocked at one point, so
/// a path that spans the fraction d of the voxel along the axis is blocked with probability c d.
/// Fine dust would block 1 - (1 - c)^d instead; `many` is the weight of that law. In the bulk of a
/// yarn, many fibers lie behind each other: optical depths add up and are larger.
/// @param voxel       optical depths along the axes
/// @param footprints  TraversalLevel::footprints
/// @param many        fiber_crowding(level)
/// @param bulk        Ray::bulk
/// @param in, out     points of entry and exit, in [0, 1]^3 of the voxel
[[nodiscard]] inline Vec3f depths_along_path(const TraversalVoxel& voxel,
                                             std::uint64_t footprints,
                                             float many,
                                             float bulk,
                                             Vec3f in,
                                             Vec3f out) {
    const Vec3f way = out - in;
    const std::array<int, 3> set = detail::count_set_cells(footprints, in, way);
    Vec3f depth{};
    for (int a = 0; a < 3; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        const auto bits = static_cast<std::uint16_t>(footprints >> (16 * a));
        const float part = std::fabs(way[a]);
        if ((bits != 0 && set[axis] == 0) || part == 0.0f) continue; // most of the time
        const float swept = detail::swept_coverage(voxel.depth[axis], bits, set[axis]);
        depth[a] = detail::depth_of_part(swept, part, many, bulk);
    }
    return depth;
}

/// Returns how crowded the columns of a level are with fibers behind each other, in [0, 0.3]. It
/// grows with the voxel's edge in fiber radii, and is fitted to the transmittance of traced
/// geometry (docs/transport.md).
[[nodiscard]] inline float fiber_crowding(const TraversalLevel& level) {
    constexpr float kFrom = 4.5f; // log2 of an edge of 23 radii
    constexpr float kRise = 0.15f;
    constexpr float kMost = 0.3f;
    return std::clamp((level.fibers_across() - kFrom) * kRise, 0.0f, kMost);
}

} // namespace heddle
