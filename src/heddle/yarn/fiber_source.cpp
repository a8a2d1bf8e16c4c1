#include <heddle/yarn/fiber_source.h>

#include <heddle/base/parallel.h>
#include <heddle/yarn/yarn_section.h>

#include <algorithm>
#include <cmath>

namespace heddle {
namespace {

constexpr std::size_t kGrain = 4096;

double arc_length(const Cubic& c) {
    // five-point Gauss-Legendre on the speed
    constexpr double kX[5] = {0.04691007703066800, 0.23076534494715845, 0.5, 0.76923465505284155,
                              0.95308992296933200};
    constexpr double kW[5] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                              0.23931433524968324, 0.11846344252809454};
    double sum = 0.0;
    for (int i = 0; i < 5; ++i) sum += kW[i] * length(c.derivative(kX[i]));
    return sum;
}

/// Transports a normal from one point to the next without rotation about the tangent.
///                                        [Wang 2008, "Computation of rotation minimizing frames"]
Vec3d transport(Vec3d normal, Vec3d p0, Vec3d t0, Vec3d p1, Vec3d t1) {
    const Vec3d v1 = p1 - p0;
    const double c1 = dot(v1, v1);
    if (c1 <= 0.0) return normal;
    const Vec3d r = normal - (2.0 / c1 * dot(v1, normal)) * v1;
    const Vec3d t = t0 - (2.0 / c1 * dot(v1, t0)) * v1;
    const Vec3d v2 = t1 - t;
    const double c2 = dot(v2, v2);
    return c2 <= 0.0 ? r : r - (2.0 / c2 * dot(v2, r)) * v2;
}

Vec3d tangent_at(const Cubic& c, double t) {
    const Vec3d d = c.derivative(t);
    if (dot(d, d) > 0.0) return normalize(d);
    return normalize(c.at(1.0) - c.at(0.0), Vec3d{0.0, 0.0, 1.0});
}

template <typename T>
const T* data_or_null(const std::vector<T>& v) {
    return v.empty() ? nullptr : v.data();
}

/// Returns the view of a set, without the data that are computed for yarns.
CurveSetView points_of(const CurveSet& set) {
    CurveSetView view;
    view.points = set.points.data();
    view.first = set.first.data();
    view.closed = data_or_null(set.closed);
    view.radius = data_or_null(set.radius);
    view.color = data_or_null(set.color);
    view.curve_count = set.curve_count();
    view.default_radius = set.default_radius;
    view.material = set.material;
    view.basis = set.basis;
    return view;
}

} // namespace

YarnView yarn_view(const YarnType& yarn) {
    return {.model = yarn.model,
            .ply_clockwise = yarn.ply_clockwise,
            .fiber_clockwise = yarn.fiber_clockwise,
            .migration = yarn.migration,
            .flyaways = yarn.flyaways,
            .radius = yarn.radius,
            .model_radius = yarn.model_radius,
            .reach = yarn_reach(yarn),
            .fiber_radius = yarn.fiber_radius,
            .plies = yarn.plies,
            .fibers_per_ply = yarn.fibers_per_ply,
            .ply_pitch = yarn.ply_pitch,
            .fiber_pitch = yarn.fiber_pitch,
            .ply_offset = yarn.ply_offset,
            .ellipse_long = yarn.ellipse_long,
            .ellipse_short = yarn.ellipse_short,
            .migration_frequency = yarn.migration_frequency,
            .migration_min = yarn.migration_min,
            .migration_max = yarn.migration_max,
            .hair_density = yarn.hair_density,
            .hair_ze = yarn.hair_ze,
            .hair_r0 = yarn.hair_r0,
            .hair_re = yarn.hair_re,
            .hair_pe = yarn.hair_pe,
            .loop_density = yarn.loop_density,
            .loop_r1 = yarn.loop_r1,
            .twist = yarn.twist};
}

Cubic span_cubic(const CurveSet& set, std::size_t curve, std::size_t k) {
    return span_cubic(points_of(set), curve, k);
}

FiberSource::FiberSource(const Geometry& geometry, double piece_length, std::uint64_t seed)
    : geometry_(geometry),
      piece_length_(piece_length),
      seed_(seed),
      first_span_(1, 0),
      curve_spans_(geometry.curves.size()),
      frames_(geometry.curves.size()) {
    for (std::uint32_t s = 0; s < geometry.curves.size(); ++s) {
        const CurveSet& set = geometry.curves[s];
        std::vector<std::uint64_t>& spans = curve_spans_[s];
        spans.resize(set.curve_count() + 1);
        for (std::size_t c = 0; c < set.curve_count(); ++c) {
            spans[c + 1] = spans[c] + set.span_count(c);
        }
        first_span_.push_back(first_span_.back() + spans.back());
        const YarnType* yarn = yarn_of(s);
        if (yarn != nullptr && yarn->model != YarnModel::Solid) build_frames(s);
        CurveSetView& view = sets_.emplace_back(points_of(set));
        view.spans = spans.data();
        view.length = data_or_null(frames_[s].length);
        view.normal = data_or_null(frames_[s].normal);
        view.closing = data_or_null(frames_[s].closing);
        view.has_yarn = yarn != nullptr;
        if (yarn != nullptr) view.yarn = yarn_view(*yarn);
    }
    measure_fibers();
}

void FiberSource::build_frames(std::uint32_t s) {
    const CurveSet& set = geometry_.curves[s];
    const std::vector<std::uint64_t>& spans = curve_spans_[s];
    YarnFrames& frames = frames_[s];
    frames.length.resize(spans.back() + set.curve_count());
    frames.normal.resize(frames.length.size());
    frames.closing.resize(set.curve_count());
    parallel_chunks(set.curve_count(), 1, [&](std::size_t c, std::size_t) {
        const std::size_t count = spans[c + 1] - spans[c];
        if (count == 0) return;
        const std::size_t knot = spans[c] + c; // a curve has one knot more than spans
        Cubic cubic = span_cubic(set, c, 0);
        Vec3d tangent = tangent_at(cubic, 0.0);
        Vec3d normal = any_perpendicular(tangent);
        double sum = 0.0;
        frames.normal[knot] = to_float(normal);
        for (std::size_t k = 0; k < count; ++k) {
            cubic = span_cubic(set, c, k);
            frames.length[knot + k] = sum;
            sum += arc_length(cubic);
            const Vec3d next = tangent_at(cubic, 1.0);
            normal = transport(normal, cubic.c[0], tangent, cubic.at(1.0), next);
            normal = normalize(normal - dot(normal, next) * next, any_perpendicular(next));
            tangent = next;
            frames.normal[knot + k + 1] = to_float(normal);
        }
        frames.length[knot + count] = sum;
        if (set.is_closed(c)) {
            const Vec3d start = to_double(frames.normal[knot]);
            frames.closing[c] = static_cast<float>(
                std::atan2(dot(cross(normal, start), tangent), dot(normal, start)) /
                6.283185307179586);
        }
    });
}

void FiberSource::measure_fibers() {
    for (std::uint32_t s = 0; s < geometry_.curves.size(); ++s) {
        const std::uint64_t begin = first_span_[s];
        const double total = reduce_chunks(
            first_span_[s + 1] - begin, kGrain, 0.0,
            [&](std::size_t b, std::size_t e) {
                double sum = 0.0;
                for (std::size_t i = b; i < e; ++i) {
                    const std::uint64_t curve = range_of(sets_[s].spans, sets_[s].curve_count, i);
                    sum += arc_length(span_cubic(sets_[s], curve, i - sets_[s].spans[curve]));
                }
                return sum;
            },
            [](double a, double b) { return a + b; });
        fiber_length_ += total * static_cast<double>(fiber_count(s));
    }
}

const YarnType* FiberSource::yarn_of(std::uint32_t set) const {
    return geometry_.yarn_of(geometry_.curves[set]);
}

std::int64_t FiberSource::fiber_count(std::uint32_t set) const {
    const YarnType* yarn = yarn_of(set);
    return yarn == nullptr ? 1 : yarn->fiber_count();
}

std::int64_t FiberSource::byte_count() const {
    std::size_t bytes = 0;
    for (const auto& spans : curve_spans_) bytes += spans.capacity() * sizeof(spans[0]);
    for (const YarnFrames& f : frames_) {
        bytes += f.length.capacity() * sizeof(double) + f.normal.capacity() * sizeof(Vec3f) +
                 f.closing.capacity() * sizeof(float);
    }
    return static_cast<std::int64_t>(bytes);
}

} // namespace heddle
