#include <heddle/render/embree/yarn_curves.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/render/embree/yarn_path.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace heddle {
namespace {

const CurveSet& set_of(const FiberSource& source, YarnSet yarns) {
    return source.geometry().curves[yarns.set];
}

/// The ranges of one curve's fibers among the segments and control points of its set.
struct CurvePlace {
    std::uint64_t first_span = 0;
    std::uint64_t segments = 0; ///< of one fiber
    std::uint64_t points = 0;   ///< of one fiber
    std::uint64_t first_segment = 0;
    std::uint64_t first_point = 0;
};

std::vector<CurvePlace> place_curves(const FiberSource& source, YarnSet yarns, int cubics) {
    const CurveSet& set = set_of(source, yarns);
    const auto fibers = static_cast<std::uint64_t>(source.fiber_count(yarns.set));
    std::vector<CurvePlace> places(set.curve_count() + 1);
    places[0].first_span = yarns.first_span;
    for (std::size_t c = 0; c < set.curve_count(); ++c) {
        CurvePlace& at = places[c];
        const std::uint64_t spans = set.span_count(c);
        at.segments = spans * static_cast<std::uint64_t>(cubics);
        at.points = spans == 0 ? 0 : 3 * at.segments + 1;
        places[c + 1].first_span = at.first_span + spans;
        places[c + 1].first_segment = at.first_segment + fibers * at.segments;
        places[c + 1].first_point = at.first_point + fibers * at.points;
    }
    return places;
}

/// Adds the fibers of one curve, one after the other.
void fill_curve(const YarnPath& path, int cubics, const CurvePlace& at, RoundCurves& out) {
    RoundPoint* const points = out.points.data() + at.first_point;
    const std::size_t n = at.segments;
    const std::size_t stride = at.points;
    for (std::size_t i = 0; i < stride; ++i) {
        const double t = static_cast<double>(i) / (3.0 * cubics);
        path.for_each_fiber(t, [&](std::size_t f, Vec3d p, double radius) {
            points[f * stride + i] = round_point(p, radius);
        });
    }
    for (std::size_t f = 0; f < path.table().size(); ++f) {
        std::uint32_t* const segments = out.segments.data() + at.first_segment + f * n;
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t first = f * stride + 3 * i;
            to_bezier(points + first);
            segments[i] = static_cast<std::uint32_t>(at.first_point + first);
        }
    }
}

/// Returns the distance of a point from a line: an offset along the fiber is no error.
double distance_across(Vec3d p, Vec3d on, Vec3d along) {
    const Vec3d d = p - on;
    return length(d - dot(d, along) * along);
}

/// Returns the positions of all fibers.
std::vector<Vec3d> fibers_at(const YarnPath& path, double t) {
    std::vector<Vec3d> out(path.table().size());
    path.for_each_fiber(t, [&](std::size_t f, Vec3d p, double) { out[f] = p; });
    return out;
}

/// Adds the largest distance of each fiber from its cubic over knots [t, t + dt], in fiber radii,
/// measured at three points between those that the cubic interpolates.
void measure_errors(const YarnPath& path, double t, double dt, std::vector<double>& out) {
    std::vector<Vec3d> node[4];
    for (int i = 0; i < 4; ++i) node[i] = fibers_at(path, t + dt * i / 3.0);
    std::vector<double> worst(path.table().size(), 0.0);
    const double radius = static_cast<double>(path.table().fiber_radius) * path.at(t).scale;
    for (const double x : {0.12, 0.5, 0.88}) {
        // Lagrange's weights, and an approximate direction of the fiber
        const double a = 3.0 * x, b = a - 1.0, c = a - 2.0, d = a - 3.0;
        const double w[4] = {-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0};
        const std::vector<Vec3d> truth = fibers_at(path, t + dt * x);
        const std::vector<Vec3d> next = fibers_at(path, t + dt * (x + 0.01));
        for (std::size_t f = 0; f < worst.size(); ++f) {
            Vec3d at;
            for (int i = 0; i < 4; ++i) at = at + w[i] * node[i][f];
            const Vec3d along = normalize(next[f] - truth[f]);
            worst[f] = std::max(worst[f], distance_across(at, truth[f], along));
        }
    }
    for (const double w : worst) out.push_back(w / std::max(radius, 1e-300));
}

void check_count(std::uint64_t points) {
    if (points <= std::numeric_limits<std::uint32_t>::max()) return;
    throw Error(
        ErrorCode::Unsupported,
        str("the fibers of a set of yarns have ", points, " control points (limit 2^32 - 1)"),
        "use fewer fibers a yarn, a larger tolerance, or split the yarns over several files");
}

} // namespace

double cubic_error(const FiberSource& source, YarnSet yarns, int cubics) {
    constexpr std::size_t kCurves = 16;
    constexpr std::size_t kCubics = 16;
    const std::vector<CurvePlace> places = place_curves(source, yarns, cubics);
    const std::size_t all = places.size() - 1;
    const std::size_t curves = std::min(kCurves, all);
    std::vector<double> errors;
    for (std::size_t i = 0; i < curves; ++i) {
        const CurvePlace& at = places[i * all / curves];
        if (at.segments == 0) continue;
        const YarnPath path(source, at.first_span, yarns.unit);
        const std::size_t count = std::min<std::size_t>(kCubics, at.segments);
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t cubic = (2 * k + 1) * at.segments / (2 * count);
            measure_errors(path, static_cast<double>(cubic) / cubics, 1.0 / cubics, errors);
        }
    }
    if (errors.empty()) return 0.0;
    const auto ninth = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 9 / 10);
    std::nth_element(errors.begin(), ninth, errors.end());
    return *ninth;
}

int choose_cubics(const FiberSource& source, YarnSet yarns, float tolerance) {
    for (const int cubics : {1, 2, 3, 4, 6, 8, 12}) {
        if (cubic_error(source, yarns, cubics) <= static_cast<double>(tolerance)) return cubics;
    }
    return 16;
}

std::uint64_t count_yarn_segments(const FiberSource& source, YarnSet yarns, int cubics) {
    return place_curves(source, yarns, cubics).back().first_segment;
}

RoundCurves yarn_curves(const FiberSource& source, YarnSet yarns, int cubics, Progress& progress) {
    const CurveSet& set = set_of(source, yarns);
    const std::vector<CurvePlace> places = place_curves(source, yarns, cubics);
    check_count(places.back().first_point);
    RoundCurves out;
    out.basis = RoundBasis::Bezier;
    out.material = set.material;
    out.points.resize(places.back().first_point);
    out.segments.resize(places.back().first_segment);
    const bool colored = source.yarn_of(yarns.set)->model == YarnModel::Slice;
    const auto fibers = static_cast<std::size_t>(source.fiber_count(yarns.set));
    out.runs.resize(set.curve_count());
    if (colored) out.colors.resize(set.curve_count() * fibers, 0xffffff);
    progress.begin("fibers", "segments", static_cast<std::int64_t>(out.segments.size()));
    parallel_chunks(set.curve_count(), 1, [&](std::size_t c, std::size_t) {
        const CurvePlace& at = places[c];
        out.runs[c] = {static_cast<std::uint32_t>(at.first_segment),
                       static_cast<std::uint32_t>(c * fibers),
                       static_cast<std::uint32_t>(std::max<std::uint64_t>(at.segments, 1))};
        if (at.segments == 0) return;
        progress.check();
        const YarnPath path(source, at.first_span, yarns.unit);
        fill_curve(path, cubics, at, out);
        if (colored) {
            std::copy_n(path.table().color.begin(), path.table().size(),
                        out.colors.begin() + static_cast<std::ptrdiff_t>(c * fibers));
        }
        progress.advance(static_cast<std::int64_t>(at.segments * fibers));
    });
    return out;
}

} // namespace heddle
