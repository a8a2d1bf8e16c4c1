#pragma once

#include <heddle/base/vec.h>

#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

enum class Basis : std::uint8_t {
    Linear,      ///< polyline through its points
    CatmullRom,  ///< uniform Catmull-Rom; the ends of an open curve only give tangents
    CubicBSpline ///< uniform cubic B-spline; an open curve starts near its second point
};

/// Many curves of one basis: yarn centrelines or hair strands.
///
/// Curve c has the points [first[c], first[c + 1]). A closed curve does not repeat its first point.
struct CurveSet {
    Basis basis = Basis::CatmullRom;
    std::vector<Vec3f> points;        ///< n control points, scene units, finite
    std::vector<std::uint64_t> first; ///< curves + 1 offsets into `points`, ascending, first is 0
    std::vector<std::uint8_t> closed; ///< per curve, 1 = closed; empty: no curve is closed
    std::vector<float> radius;        ///< per point, scene units; empty: `default_radius`
    float default_radius = 0.0f;      ///< scene units; 0: the file gives none
    /// per point, linear RGB, 8 bits each in bits 0-23; empty: white
    std::vector<std::uint32_t> color;
    std::uint32_t material = 0; ///< index into Geometry::materials
    std::int32_t yarn = -1;     ///< index into Geometry::yarns; -1: each curve is one round fiber

    [[nodiscard]] std::size_t curve_count() const { return first.empty() ? 0 : first.size() - 1; }
    [[nodiscard]] bool is_closed(std::size_t curve) const {
        return !closed.empty() && closed[curve] != 0;
    }
    [[nodiscard]] float radius_at(std::size_t point) const {
        return radius.empty() ? default_radius : radius[point];
    }
    /// The number of spans of a curve, each one cubic or one line between two neighbouring knots.
    [[nodiscard]] std::size_t span_count(std::size_t curve) const {
        const std::size_t n = first[curve + 1] - first[curve];
        if (is_closed(curve)) return n < 2 ? 0 : n;
        if (basis == Basis::Linear) return n < 2 ? 0 : n - 1;
        return n < 4 ? 0 : n - 3; // the end points of an open cubic only give tangents
    }
};

} // namespace heddle
