#include <heddle/render/embree/round_curves.h>

#include <heddle/base/error.h>

#include <embree3/rtcore.h>

#include <array>
#include <limits>

namespace heddle {
namespace {

/// Returns the weights of four control points in dP/du.
std::array<float, 4> derivative_weights(RoundBasis basis, float u) {
    const float v = 1.0f - u;
    if (basis == RoundBasis::Bezier) {
        return {-3.0f * v * v, 3.0f * v * (v - 2.0f * u), 3.0f * u * (2.0f * v - u), 3.0f * u * u};
    }
    if (basis == RoundBasis::CatmullRom) {
        return {0.5f * (-3.0f * u * u + 4.0f * u - 1.0f), 0.5f * (9.0f * u * u - 10.0f * u),
                0.5f * (-9.0f * u * u + 8.0f * u + 1.0f), 0.5f * (3.0f * u * u - 2.0f * u)};
    }
    return {-0.5f * v * v, 0.5f * (3.0f * u * u - 4.0f * u),
            0.5f * (-3.0f * u * u + 2.0f * u + 1.0f), 0.5f * u * u};
}

/// Returns the radii of a curve's control points.
class PointRadius {
public:
    PointRadius(const Geometry& geometry, const CurveSet& set) : set_(set) {
        const YarnType* yarn = geometry.yarn_of(set);
        if (yarn == nullptr) return;
        fixed_ = yarn->radius;
        scale_ = 1.0f / yarn->model_radius;
    }
    [[nodiscard]] float at(std::size_t point) const {
        return scale_ * (fixed_ > 0.0f ? fixed_ : set_.radius_at(point));
    }

private:
    const CurveSet& set_;
    float fixed_ = 0.0f;
    float scale_ = 1.0f;
};

bool has_length(const RoundPoint* p, std::size_t count) {
    bool apart = false;
    for (std::size_t i = 1; i < count; ++i) {
        apart = apart || p[i].position() != p[0].position();
    }
    return apart;
}

/// Returns which ends of a linear segment join a neighbour that has a length, for Embree.
std::uint8_t neighbor_flags(const RoundPoint* segment, bool left, bool right) {
    left = left && has_length(segment - 1, 2);
    right = right && has_length(segment + 1, 2);
    return static_cast<std::uint8_t>((left ? RTC_CURVE_FLAG_NEIGHBOR_LEFT : 0) |
                                     (right ? RTC_CURVE_FLAG_NEIGHBOR_RIGHT : 0));
}

void add_curve(RoundCurves& out, const CurveSet& set, std::size_t c, const PointRadius& radius) {
    const std::size_t first = set.first[c];
    const std::size_t n = set.first[c + 1] - first;
    const std::size_t spans = set.span_count(c);
    if (spans == 0) return;
    const bool linear = set.basis == Basis::Linear;
    const bool closed = set.is_closed(c);
    // span k of a closed curve starts at point k: one point precedes the first, two follow the last
    const std::size_t count = closed ? n + 3 : n;
    const std::size_t base = out.points.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t p = first + (closed ? (i + n - 1) % n : i);
        const Vec3f at = set.points[p];
        out.points.push_back({at.x, at.y, at.z, radius.at(p)});
    }
    const std::size_t begin = base + (closed && linear ? 1 : 0);
    for (std::size_t k = 0; k < spans; ++k) {
        const RoundPoint* const segment = &out.points[begin + k];
        if (!has_length(segment, linear ? 2 : 4)) continue;
        out.segments.push_back(static_cast<std::uint32_t>(begin + k));
        if (linear) {
            out.flags.push_back(neighbor_flags(segment, closed || k > 0, closed || k + 1 < spans));
        }
        if (!set.color.empty()) {
            out.colors.push_back(set.color[first + k + (linear || closed ? 0 : 1)]);
        }
    }
}

RoundBasis round_basis(Basis basis) {
    switch (basis) {
    case Basis::Linear: return RoundBasis::Linear;
    case Basis::CatmullRom: return RoundBasis::CatmullRom;
    case Basis::CubicBSpline: return RoundBasis::CubicBSpline;
    }
    return RoundBasis::CubicBSpline;
}

} // namespace

Vec3f RoundCurves::derivative(std::uint32_t segment, float u) const {
    const RoundPoint* p = &points[segments[segment]];
    if (basis == RoundBasis::Linear) return p[1].position() - p[0].position();
    const std::array<float, 4> w = derivative_weights(basis, u);
    // of differences (the weights' sum is 0), as positions may be far from the origin
    const Vec3f origin = p[0].position();
    Vec3f sum;
    for (std::size_t i = 1; i < 4; ++i) sum = sum + (p[i].position() - origin) * w[i];
    return sum;
}

Vec3f RoundCurves::color(std::uint32_t segment) const {
    if (colors.empty()) return {1.0f, 1.0f, 1.0f};
    const auto after = std::upper_bound(
        runs.begin(), runs.end(), segment,
        [](std::uint32_t s, const ColorRun& run) { return s < run.first_segment; });
    const ColorRun& run = *(after - 1);
    const std::uint32_t rgb =
        colors[run.first_color + (segment - run.first_segment) / run.segments_per_color];
    const auto channel = [&](int bit) { return static_cast<float>(rgb >> bit & 255u) / 255.0f; };
    return {channel(0), channel(8), channel(16)};
}

std::int64_t RoundCurves::byte_count() const {
    return static_cast<std::int64_t>(points.capacity() * sizeof(RoundPoint) +
                                     segments.capacity() * sizeof(std::uint32_t) +
                                     flags.capacity() + colors.capacity() * sizeof(std::uint32_t) +
                                     runs.capacity() * sizeof(ColorRun));
}

RoundPoint round_point(Vec3d p, double radius) {
    const Vec3f at = to_float(p);
    return {at.x, at.y, at.z, static_cast<float>(radius)};
}

void to_bezier(RoundPoint* p) {
    const Vec3d p0 = to_double(p[0].position());
    const Vec3d p1 = to_double(p[1].position()) - p0; // differences keep precision
    const Vec3d p2 = to_double(p[2].position()) - p0;
    const Vec3d p3 = to_double(p[3].position()) - p0;
    const float r1 = p[1].radius, r2 = p[2].radius, ends = p[0].radius + p[3].radius;
    p[1] = round_point(p0 + 3.0 * p1 - 1.5 * p2 + (1.0 / 3.0) * p3, 0.0);
    p[2] = round_point(p0 - 1.5 * p1 + 3.0 * p2 - (5.0 / 6.0) * p3, 0.0);
    p[1].radius = (18.0f * r1 - 9.0f * r2 + 2.0f * ends - 7.0f * p[0].radius) / 6.0f;
    p[2].radius = (18.0f * r2 - 9.0f * r1 + 2.0f * ends - 7.0f * p[3].radius) / 6.0f;
}

RoundCurves plain_curves(const Geometry& geometry, const CurveSet& set) {
    RoundCurves out;
    out.basis = round_basis(set.basis);
    out.material = set.material;
    out.runs.push_back({});
    const PointRadius radius(geometry, set);
    std::uint64_t points = 0;
    std::uint64_t segments = 0;
    for (std::size_t c = 0; c < set.curve_count(); ++c) {
        segments += set.span_count(c);
        points += set.span_count(c) + 3;
    }
    if (points > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(ErrorCode::Unsupported,
                    str("a set of curves has ", points, " control points (limit 2^32 - 1)"),
                    "split the curves over several files");
    }
    out.points.reserve(points);
    out.segments.reserve(segments);
    for (std::size_t c = 0; c < set.curve_count(); ++c) add_curve(out, set, c, radius);
    return out;
}

} // namespace heddle
