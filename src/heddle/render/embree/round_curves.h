#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/curves.h>
#include <heddle/geom/geometry.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace heddle {

/// A control point as Embree reads it.
struct alignas(16) RoundPoint {
    float x = 0.0f, y = 0.0f, z = 0.0f;
    float radius = 0.0f;

    [[nodiscard]] Vec3f position() const { return {x, y, z}; }
};
static_assert(sizeof(RoundPoint) == 16);

/// Segments that share a step of colours.
struct ColorRun {
    std::uint32_t first_segment = 0;
    std::uint32_t first_color = 0;
    std::uint32_t segments_per_color = 1;
};

/// How control points make a segment.
enum class RoundBasis : std::uint8_t { Linear, CatmullRom, CubicBSpline, Bezier };

/// Round segments of one basis: what one Embree geometry holds. Object space.
struct RoundCurves {
    RoundBasis basis = RoundBasis::Linear;
    std::uint32_t material = 0;          ///< of the geometry
    std::vector<RoundPoint> points;      ///< control points
    std::vector<std::uint32_t> segments; ///< first control point of each
    std::vector<std::uint8_t> flags;     ///< linear ones: RTC_CURVE_FLAG_NEIGHBOR_*
    std::vector<std::uint32_t> colors;   ///< linear RGB, 8 bits each; empty: white
    std::vector<ColorRun> runs;          ///< ascending first_segment; the first is 0

    /// dP/du of a segment at u in [0, 1]; any length.
    [[nodiscard]] Vec3f derivative(std::uint32_t segment, float u) const;
    /// Linear RGB in [0, 1].
    [[nodiscard]] Vec3f color(std::uint32_t segment) const;
    [[nodiscard]] std::int64_t byte_count() const;
};

[[nodiscard]] RoundPoint round_point(Vec3d p, double radius);

/// Makes of four places along a cubic, at 0, 1/3, 2/3 and 1, its Bezier control points.
void to_bezier(RoundPoint* points);

/// Curves that are one fiber each, with their own points as control points. Segments without length
/// are left out.
/// @param set  of the geometry; without a yarn, or of a solid one
/// @throws Error  Unsupported: 2^32 control points or more
[[nodiscard]] RoundCurves plain_curves(const Geometry& geometry, const CurveSet& set);

} // namespace heddle
