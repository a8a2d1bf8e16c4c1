#pragma once

#include <heddle/render/volume/transport.h>
#include <heddle/render/volume/traversal_level.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

// The optical depth of a ray's own way through a voxel, by the voxel's footprints of 4 x 4 cells.

namespace heddle {

namespace detail {

/// The cells that a way sweeps are read at this many points, evenly spaced along it.
inline constexpr int kWayPoints = 4;
/// The largest coverage that a swept cell counts for: a cell stands for its columns, of which a few
/// may be open although the cell is set, so it is never opaque.
inline constexpr float kMostCovered = 1.0f - 1.0f / 128.0f;
/// The same in the bulk of a yarn, where the fibers behind a column close what it leaves open.
inline constexpr float kMostCoveredInBulk = 1.0f - 1e-4f;
/// How many times as large depths are in the bulk of a yarn: fibers stand closer there than their
/// coverage tells, because they hide each other.
inline constexpr float kBulkDepth = 1.5f;

/// For each axis: at how many of the way's points the cell of that axis's footprint is set.
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

/// Coverage of the cells that a way sweeps. Where rounding set more cells than were covered they
/// are thinned; where it set none the voxel is even.
/// @param depth  of the voxel along the axis, TraversalVoxel::depth
/// @param bits   of the axis's footprint
/// @param set    of kWayPoints points
[[nodiscard]] inline float swept_coverage(std::uint16_t depth, std::uint16_t bits, int set) {
    const float covered = 1.0f - std::exp(-kDepthUnit * static_cast<float>(depth));
    if (bits == 0) return covered;
    const float share = static_cast<float>(std::popcount(bits)) * (1.0f / 16.0f);
    return static_cast<float>(set) * (1.0f / kWayPoints) * std::min(1.0f, covered / share);
}

/// Depth of a way through the part `part` of columns whose coverage is `swept`.
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

/// Depths along the axes of a ray that takes one way through the voxel: of the cells of each face
/// that its projection sweeps.
///
/// A ray along an axis meets one cell, set or not; an oblique one the swept share of set cells is
/// its coverage c. A covered column is blocked at one place in it: of a way through the part d of
/// the voxel along the axis c d is blocked. Depths that add up, 1 - (1 - c)^d, hold for fine dust;
/// `many` is their share. In the bulk of a yarn, fibers behind fibers, they add up and are larger.
/// @param voxel       its own depths
/// @param footprints  TraversalLevel::footprints
/// @param many        fiber_crowding(level)
/// @param bulk        Ray::bulk
/// @param in, out     where the ray enters and leaves, in [0, 1]^3 of the voxel
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

/// How far a level's columns hold many fibers behind each other, in [0, 0.3]: grows with the
/// voxel's edge in fiber radii. Chosen by transmittance against traced geometry
/// (docs/transport.md).
[[nodiscard]] inline float fiber_crowding(const TraversalLevel& level) {
    constexpr float kFrom = 4.5f; // log2 of an edge of 23 radii
    constexpr float kRise = 0.15f;
    constexpr float kMost = 0.3f;
    return std::clamp((level.fibers_across() - kFrom) * kRise, 0.0f, kMost);
}

} // namespace heddle
