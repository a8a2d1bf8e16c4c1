#include <heddle/io/curve/curve_info.h>

#include <heddle/base/parallel.h>
#include <heddle/io/curve/curve_span.h>

#include <algorithm>
#include <limits>

namespace heddle {
namespace {

constexpr std::size_t kGrain = 4096; // points per chunk: about 0.2 ms of work

/// 5-point Gauss-Legendre on [0, 1]                             [Abramowitz-Stegun, table 25.4]
constexpr std::array<double, 5> kNode{0.04691007703066800, 0.23076534494715845, 0.5,
                                      0.76923465505284155, 0.95308992296933200};
constexpr std::array<double, 5> kWeight{0.11846344252809454, 0.23931433524968324,
                                        0.28444444444444444, 0.23931433524968324,
                                        0.11846344252809454};

double arc_length(const BezierSpan& b) {
    const Vec3d d0 = b[1] - b[0];
    const Vec3d d1 = b[2] - b[1];
    const Vec3d d2 = b[3] - b[2];
    double sum = 0.0;
    for (std::size_t i = 0; i < kNode.size(); ++i) {
        const double u = kNode[i];
        const double v = 1.0 - u;
        sum += kWeight[i] * length(d0 * (v * v) + d1 * (2.0 * u * v) + d2 * (u * u));
    }
    return 3.0 * sum;
}

CurveStats combine(CurveStats a, const CurveStats& b) {
    a.spans += b.spans;
    a.length += b.length;
    a.radius_min = std::min(a.radius_min, b.radius_min);
    a.radius_max = std::max(a.radius_max, b.radius_max);
    a.bounds.grow(b.bounds);
    return a;
}

CurveStats nothing() {
    CurveStats s;
    s.radius_min = std::numeric_limits<float>::infinity();
    return s;
}

CurveStats measure_chunk(const CurveSet& set, std::size_t begin, std::size_t end) {
    CurveStats s = nothing();
    for (std::size_t p = begin; p < end; ++p) {
        s.radius_min = std::min(s.radius_min, set.radius_at(p));
        s.radius_max = std::max(s.radius_max, set.radius_at(p));
    }
    visit_spans(set, begin, end, [&](std::size_t curve, std::size_t span) {
        const BezierSpan b = bezier_span(set, curve, span);
        s.spans += 1;
        s.length += arc_length(b);
        for (const Vec3d& p : b) s.bounds.grow(p);
    });
    return s;
}

} // namespace

CurveStats measure(const CurveSet& set) {
    CurveStats s = reduce_chunks(
        set.points.size(), kGrain, nothing(),
        [&](std::size_t begin, std::size_t end) { return measure_chunk(set, begin, end); },
        combine);
    if (set.points.empty()) s.radius_min = 0.0f;
    s.curves = set.curve_count();
    s.points = set.points.size();
    s.closed = static_cast<std::uint64_t>(
        std::count_if(set.closed.begin(), set.closed.end(), [](std::uint8_t c) { return c != 0; }));
    return s;
}

} // namespace heddle
