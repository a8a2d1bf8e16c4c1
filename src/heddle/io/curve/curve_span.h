#pragma once

#include <heddle/geom/curves.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace heddle {

/// One span of a curve as a cubic Bezier: its four control points, scene units.
using BezierSpan = std::array<Vec3d, 4>;

/// Index into `set.points` of the point that is `offset` points after the first one of span `span`.
/// Closed curves wrap around; the first span of a closed cubic starts at its point 0.
[[nodiscard]] inline std::size_t
span_point(const CurveSet& set, std::size_t curve, std::size_t span, std::size_t offset) {
    const std::size_t n = set.first[curve + 1] - set.first[curve];
    std::size_t local = span + offset;
    if (set.is_closed(curve)) {
        if (set.basis != Basis::Linear) local += n - 1;
        while (local >= n) local -= n; // at most twice; a 64-bit % costs more than the whole span
    }
    return set.first[curve] + local;
}

/// Span `span` of curve `curve` in Bezier form, whatever its basis; exact up to double rounding.
/// @param span  < set.span_count(curve)
[[nodiscard]] inline BezierSpan
bezier_span(const CurveSet& set, std::size_t curve, std::size_t span) {
    const auto point = [&](std::size_t offset) {
        return to_double(set.points[span_point(set, curve, span, offset)]);
    };
    if (set.basis == Basis::Linear) {
        const Vec3d a = point(0);
        const Vec3d b = point(1);
        return {a, a + (b - a) * (1.0 / 3.0), b - (b - a) * (1.0 / 3.0), b};
    }
    const Vec3d p0 = point(0);
    const Vec3d p1 = point(1);
    const Vec3d p2 = point(2);
    const Vec3d p3 = point(3);
    if (set.basis == Basis::CatmullRom) {
        return {p1, p1 + (p2 - p0) * (1.0 / 6.0), p2 - (p3 - p1) * (1.0 / 6.0), p2};
    }
    const Vec3d b1 = (2.0 * p1 + p2) * (1.0 / 3.0);
    const Vec3d b2 = (p1 + 2.0 * p2) * (1.0 / 3.0);
    return {((p0 + 2.0 * p1) * (1.0 / 3.0) + b1) * 0.5, b1, b2,
            (b2 + (2.0 * p2 + p3) * (1.0 / 3.0)) * 0.5};
}

/// Position at parameter u in [0, 1].
[[nodiscard]] inline Vec3d evaluate(const BezierSpan& b, double u) {
    const double v = 1.0 - u;
    return b[0] * (v * v * v) + b[1] * (3.0 * u * v * v) + b[2] * (3.0 * u * u * v) +
           b[3] * (u * u * u);
}

/// Calls visit(curve, span) for every span that starts at a point in [begin, end) of `set.points`.
/// Chunks of points then visit every span of the set once, with even work for one long curve and
/// for many short ones.
template <typename Visit>
void visit_spans(const CurveSet& set, std::size_t begin, std::size_t end, const Visit& visit) {
    const auto after = std::upper_bound(set.first.begin(), set.first.end(), begin);
    std::size_t curve = static_cast<std::size_t>(after - set.first.begin()) - 1;
    for (std::size_t p = begin; p < end; ++curve) {
        const std::size_t stop = std::min<std::size_t>(end, set.first[curve + 1]);
        const std::size_t spans = set.span_count(curve);
        for (; p < stop; ++p) {
            if (p - set.first[curve] < spans) visit(curve, p - set.first[curve]);
        }
    }
}

} // namespace heddle
