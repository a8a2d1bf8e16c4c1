#pragma once

#include <heddle/geom/bounds.h>
#include <heddle/geom/curves.h>

#include <cstdint>

namespace heddle {

/// What `heddle info` says of a set of curves.
struct CurveStats {
    std::uint64_t curves = 0;
    std::uint64_t points = 0; ///< control points, phantom end points included
    std::uint64_t spans = 0;  ///< pieces that are drawn
    std::uint64_t closed = 0; ///< closed curves
    double length = 0.0;      ///< arc length of what is drawn, scene units
    float radius_min = 0.0f;  ///< over all control points, scene units
    float radius_max = 0.0f;  ///< scene units
    Bounds bounds;            ///< holds the centrelines (their Bezier hulls), radius not added
};

/// Counts, length and extent of the curves that `set` describes, not of its control polygons.
///
/// Length: 5-point Gauss-Legendre on every span; exact for straight ones, within 2e-6 on the shared
/// yarn files (four chords a span: 2e-3). Bounds: the hull of every span's Bezier form, which holds
/// the curve and is a few percent of a span larger at most.
/// Parallel; the same bits for any thread count.
[[nodiscard]] CurveStats measure(const CurveSet& set);

} // namespace heddle
