#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/curves.h>
#include <heddle/geom/geometry.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace heddle {

/// A control point in Embree's layout.
struct alignas(16) RoundPoint {
    float x = 0.0f, y = 0.0f, z = 0.0f;
    float radius = 0.0f;

    [[nodiscard]] Vec3f position() const { return {x, y, z}; }
};
static_assert(sizeof(RoundPoint) == 16);

/// Segments, each of whose colours holds for the same number of segments.
struct ColorRun {
    std::uint32_t first_segment = 0;
    std::uint32_t first_color = 0;
    std::uint32_t segments_per_color = 1;
};

/// The basis by which control points define a segment.
enum class RoundBasis : std::uint8_t { Linear, CatmullRom, CubicBSpline, Bezier };

/// Round segments of one basis, for one Embree geometry. Object space.
struct RoundCurves {
    RoundBasis basis = RoundBasis::Linear;
    std::uint32_t material = 0;          ///< index among the geometry's
    std::vector<RoundPoint> points;      ///< control points
    std::vector<std::uint32_t> segments; ///< index of each segment's first control point
    std::vector<std::uint8_t> flags;     ///< for linear segments: RTC_CURVE_FLAG_NEIGHBOR_*
    std::vector<std::uint32_t> colors;   ///< linear RGB, 8 bits each; empty: white
    std::vector<ColorRun> runs;          ///< by first_segment, ascending from 0

    /// Returns dP/du of a segment at u in [0, 1], up to its length.
    [[nodiscard]] Vec3f derivative(std::uint32_t segment, float u) const;
    /// Returns the colour of a segment, linear RGB in [0, 1].
    [[nodiscard]] Vec3f color(std::uint32_t segment) const;
    [[nodiscard]] std::int64_t byte_count() const;
};

[[nodiscard]] RoundPoint round_point(Vec3d p, double radius);

/// Replaces four points of a cubic, at 0, 1/3, 2/3 and 1, by its Bezier control points.
void to_bezier(RoundPoint* points);

/// Returns the segments of curves that are one fiber each, with the curves' control points.
/// Segments without length are left out.
/// @param set     a set of the geometry, without a yarn or with a solid one
/// @throws Error  Unsupported: 2^32 control points or more
[[nodiscard]] RoundCurves plain_curves(const Geometry& geometry, const CurveSet& set);

} // namespace heddle
