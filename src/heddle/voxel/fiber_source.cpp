#include <heddle/voxel/fiber_source.h>

#include <heddle/base/parallel.h>

#include <algorithm>
#include <cmath>

namespace heddle {
namespace {

/// A piece is at most this long, in units: half a block, so that a long hair visits the blocks along
/// it and not those of its box, and single precision resolves 1e-5 of a subvoxel beside its anchor.
constexpr double kPieceLength = 128.0;

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

/// Carries a normal from one point to the next without turn about the tangent.
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

Vec3d perpendicular(Vec3d t) {
    return to_double(any_perpendicular(to_float(t)));
}

} // namespace

Cubic Cubic::part(double t0, double dt) const {
    return {{at(t0), dt * derivative(t0), (dt * dt) * (c[2] + (3.0 * t0) * c[3]),
             (dt * dt * dt) * c[3]}};
}

double Cubic::polygon_length() const {
    // Bernstein differences: c1 / 3, (c1 + c2) / 3, (c1 + 2 c2 + 3 c3) / 3 ... in power form
    const Vec3d b1 = (1.0 / 3.0) * c[1];
    const Vec3d b2 = b1 + (1.0 / 3.0) * c[2];
    const Vec3d b3 = b2 + (1.0 / 3.0) * c[2] + c[3];
    return length(b1) + length(b2) + length(b3);
}

Bounds Cubic::hull() const {
    Bounds box;
    const Vec3d p1 = c[0] + (1.0 / 3.0) * c[1];
    const Vec3d p2 = p1 + (1.0 / 3.0) * c[1] + (1.0 / 3.0) * c[2];
    box.grow(c[0]);
    box.grow(p1);
    box.grow(p2);
    box.grow(at(1.0));
    return box;
}

Cubic span_cubic(const CurveSet& set, std::size_t curve, std::size_t k) {
    const std::size_t first = set.first[curve];
    const std::size_t n = set.first[curve + 1] - first;
    const bool closed = set.is_closed(curve);
    const auto point = [&](std::size_t i) {
        return to_double(set.points[first + (closed ? i % n : i)]);
    };
    if (set.basis == Basis::Linear) {
        const Vec3d p0 = point(k);
        return {{p0, point(k + 1) - p0, {}, {}}};
    }
    const Vec3d p0 = point(closed ? k + n - 1 : k);
    const Vec3d p1 = point(closed ? k : k + 1);
    const Vec3d p2 = point(closed ? k + 1 : k + 2);
    const Vec3d p3 = point(closed ? k + 2 : k + 3);
    if (set.basis == Basis::CatmullRom) {
        return {{p1, 0.5 * (p2 - p0), p0 - 2.5 * p1 + 2.0 * p2 - 0.5 * p3,
                 0.5 * (p3 - p0) + 1.5 * (p1 - p2)}};
    }
    return {{(1.0 / 6.0) * (p0 + 4.0 * p1 + p2), 0.5 * (p2 - p0), 0.5 * (p0 - 2.0 * p1 + p2),
             (1.0 / 6.0) * (p3 - p0) + 0.5 * (p1 - p2)}};
}

FiberSource::FiberSource(const Geometry& geometry, const LatticeUnits& units, std::uint64_t seed)
    : geometry_(geometry),
      units_(units),
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
    }
    count_steps();
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
        Vec3d normal = perpendicular(tangent);
        double sum = 0.0;
        frames.normal[knot] = to_float(normal);
        for (std::size_t k = 0; k < count; ++k) {
            cubic = span_cubic(set, c, k);
            frames.length[knot + k] = sum;
            sum += arc_length(cubic);
            const Vec3d next = tangent_at(cubic, 1.0);
            normal = transport(normal, cubic.c[0], tangent, cubic.at(1.0), next);
            normal = normalize(normal - dot(normal, next) * next, perpendicular(next));
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

void FiberSource::count_steps() {
    for (std::uint32_t s = 0; s < geometry_.curves.size(); ++s) {
        const std::uint64_t begin = first_span_[s];
        const double total = reduce_chunks(
            first_span_[s + 1] - begin, kGrain, 0.0,
            [&](std::size_t b, std::size_t e) {
                double sum = 0.0;
                for (std::size_t i = b; i < e; ++i) {
                    const SpanPlace at = place(begin + i);
                    sum += arc_length(span_cubic(geometry_.curves[s], at.curve, at.k));
                }
                return sum;
            },
            [](double a, double b) { return a + b; });
        steps_ += total / units_.unit * static_cast<double>(fiber_count(s));
    }
}

FiberSource::SpanPlace FiberSource::place(std::uint64_t span) const {
    const auto set = std::upper_bound(first_span_.begin() + 1, first_span_.end(), span) - 1;
    const auto s = static_cast<std::uint32_t>(set - first_span_.begin());
    const std::uint64_t local = span - *set;
    const std::vector<std::uint64_t>& spans = curve_spans_[s];
    const auto curve = std::upper_bound(spans.begin() + 1, spans.end(), local) - 1;
    return {s, static_cast<std::uint64_t>(curve - spans.begin()), local - *curve};
}

FiberPiece FiberSource::whole_span(std::uint64_t span) const {
    const SpanPlace at = place(span);
    const Cubic cubic = span_cubic(geometry_.curves[at.set], at.curve, at.k);
    const double parts = std::ceil(cubic.polygon_length() / (kPieceLength * units_.unit));
    return {.set = at.set,
            .parts =
                static_cast<std::uint32_t>(std::clamp(parts, 1.0, static_cast<double>(kMaxParts))),
            .curve = at.curve,
            .span = at.k,
            .cubic = cubic};
}

FiberPiece FiberSource::part_of(const FiberPiece& span, std::uint32_t part) {
    FiberPiece piece = span;
    piece.part = part;
    if (span.parts > 1) {
        const double dt = 1.0 / span.parts;
        piece.cubic = span.cubic.part(part * dt, dt);
    }
    return piece;
}

const YarnType* FiberSource::yarn_of(std::uint32_t set) const {
    return geometry_.yarn_of(geometry_.curves[set]);
}

std::int64_t FiberSource::fiber_count(std::uint32_t set) const {
    const YarnType* yarn = yarn_of(set);
    return yarn == nullptr ? 1 : yarn->fiber_count();
}

namespace {

/// Yarn radius at a span's end, scene units.
double radius_at(const CurveSet& set, const YarnType* yarn, const FiberPiece& piece, bool end) {
    if (yarn != nullptr && yarn->radius > 0.0f) return static_cast<double>(yarn->radius);
    const std::size_t first = set.first[piece.curve];
    const std::size_t n = set.first[piece.curve + 1] - first;
    const bool closed = set.is_closed(piece.curve);
    const std::size_t skip = closed || set.basis == Basis::Linear ? 0 : 1;
    const auto knot = [&](std::size_t k) {
        return static_cast<double>(set.radius_at(first + (closed ? k % n : k + skip)));
    };
    const double t = (piece.part + (end ? 1.0 : 0.0)) / piece.parts;
    return (1.0 - t) * knot(piece.span) + t * knot(piece.span + 1);
}

} // namespace

double FiberSource::reach(const FiberPiece& piece) const {
    const CurveSet& set = geometry_.curves[piece.set];
    const YarnType* yarn = yarn_of(piece.set);
    const double radius =
        std::max(radius_at(set, yarn, piece, false), radius_at(set, yarn, piece, true));
    if (yarn == nullptr) return radius;
    return radius * static_cast<double>(yarn_reach(*yarn) / yarn->model_radius);
}

YarnCourse FiberSource::course(const FiberPiece& piece) const {
    const CurveSet& set = geometry_.curves[piece.set];
    const YarnType* yarn = yarn_of(piece.set);
    YarnCourse course;
    const double r0 = radius_at(set, yarn, piece, false);
    const double r1 = radius_at(set, yarn, piece, true);
    const double model = yarn == nullptr ? 1.0 : static_cast<double>(yarn->model_radius);
    course.scale0 = static_cast<float>(r0 / units_.unit / model);
    course.scale1 = static_cast<float>(r1 / units_.unit / model);
    const YarnFrames& frames = frames_[piece.set];
    if (frames.length.empty()) return course;

    const std::vector<std::uint64_t>& spans = curve_spans_[piece.set];
    const std::size_t knot = spans[piece.curve] + piece.curve;
    const std::size_t count = spans[piece.curve + 1] - spans[piece.curve];
    FiberPiece head =
        piece; // twist and hairs go by the radius at the yarn's head, the section by its own
    head.span = 0;
    head.part = 0;
    const double per_scene = model / std::max(radius_at(set, yarn, head, false), 1e-300);
    const double s0 = frames.length[knot + piece.span];
    const double s1 = frames.length[knot + piece.span + 1];
    const double dt = 1.0 / piece.parts;
    course.start = (s0 + (s1 - s0) * dt * piece.part) * per_scene;
    course.length = (s1 - s0) * dt * per_scene;
    course.total = frames.length[knot + count] * per_scene;
    course.closed = set.is_closed(piece.curve);
    course.closing_turns = static_cast<double>(frames.closing[piece.curve]);
    const Vec3f n0 = frames.normal[knot + piece.span];
    const Vec3f n1 = frames.normal[knot + piece.span + 1];
    const auto t0 = static_cast<float>(dt * piece.part);
    const auto t1 = static_cast<float>(dt * (piece.part + 1));
    course.normal0 = n0 * (1.0f - t0) + n1 * t0;
    course.normal1 = n0 * (1.0f - t1) + n1 * t1;

    double* turns = course.turns_per_length;
    if (yarn->model == YarnModel::Slice) {
        turns[1] = static_cast<double>(yarn->twist) / 6.283185307179586;
    } else {
        const double direction = yarn->fiber_clockwise ? -1.0 : 1.0;
        turns[0] = (yarn->ply_clockwise ? -1.0 : 1.0) / static_cast<double>(yarn->ply_pitch);
        turns[1] = direction / static_cast<double>(yarn->fiber_pitch);
        turns[2] = turns[1] * static_cast<double>(yarn->migration_frequency);
    }
    if (course.closed && course.total > 0.0) {
        for (int i = 0; i < 3; ++i) turns[i] = std::round(turns[i] * course.total) / course.total;
    }
    return course;
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
