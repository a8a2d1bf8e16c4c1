#include <heddle/render/embree/yarn_curves.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/render/embree/yarn_path.h>
#include <heddle/yarn/flyaway.h>

#include <cmath>
#include <limits>

namespace heddle {
namespace {

/// Returns the cubics of a hair: about one per span of its yarn, and one per radian of its turn.
int cubic_count(const YarnPath& path, const FlyawayHair& hair) {
    const double dt = hair.t1 - hair.t0;
    const double spans =
        std::abs(hair.ze) * dt / path.total() * static_cast<double>(path.span_count());
    return static_cast<int>(std::clamp(std::ceil(spans + std::abs(hair.pe) * dt), 1.0, 64.0));
}

RoundPoint hair_at(const YarnPath& path, std::size_t ply, const FlyawayHair& hair, double q) {
    const double s = std::clamp(hair.z0 + hair.ze * q, 0.0, path.total());
    const TracedYarnFrame yarn = path.at(path.knot_of_length(s));
    const TracedPlyFrame at = path.ply(yarn, ply);
    const double angle = hair.p0 + hair.pe * q;
    const double r = hair.r0 + hair.re * q;
    const double offset = static_cast<double>(path.yarn().ply_offset);
    return round_point(at.center + (offset + r * std::cos(angle)) * at.u +
                           (r * std::sin(angle)) * at.v,
                       static_cast<double>(path.table().fiber_radius) * yarn.scale);
}

/// Collects hairs as Bezier cubics.
struct HairCurves {
    std::vector<RoundPoint> points;
    std::vector<std::uint32_t> segments;

    void add(const YarnPath& path, std::size_t ply, const FlyawayHair& hair) {
        const int count = cubic_count(path, hair);
        const std::size_t base = points.size();
        for (int j = 0; j <= 3 * count; ++j) {
            const double q = hair.t0 + (hair.t1 - hair.t0) * j / (3.0 * count);
            points.push_back(hair_at(path, ply, hair, q));
        }
        for (int j = 0; j < count; ++j) {
            const std::size_t first = base + 3 * static_cast<std::size_t>(j);
            to_bezier(&points[first]);
            segments.push_back(static_cast<std::uint32_t>(first));
        }
    }
};

HairCurves hairs_of(const FiberSource& source, std::uint64_t first_span, double unit) {
    const YarnPath path(source, first_span, unit);
    const HairModel model(HairShape(path.yarn()), path.total(), path.closed());
    HairCurves out;
    for (std::size_t ply = 0; ply < path.ply_count(); ++ply) {
        model.for_each({path.seed(), path.curve(), ply}, 0.0, path.total(),
                       [&](const FlyawayHair& hair) { out.add(path, ply, hair); });
    }
    return out;
}

} // namespace

RoundCurves yarn_hairs(const FiberSource& source, YarnSet yarns, Progress& progress) {
    const CurveSet& set = source.geometry().curves[yarns.set];
    const YarnType& yarn = *source.yarn_of(yarns.set);
    RoundCurves out;
    out.basis = RoundBasis::Bezier;
    out.material = set.material;
    out.runs.push_back({});
    if (!yarn.flyaways || !(yarn.hair_density > 0.0f) || yarn.model != YarnModel::Procedural) {
        return out;
    }
    std::vector<std::uint64_t> first(1, yarns.first_span);
    for (std::size_t c = 0; c < set.curve_count(); ++c) {
        first.push_back(first.back() + set.span_count(c));
    }
    progress.begin("flyaways", "yarns", static_cast<std::int64_t>(set.curve_count()));
    std::vector<HairCurves> hairs(set.curve_count());
    parallel_chunks(set.curve_count(), 1, [&](std::size_t c, std::size_t) {
        progress.check();
        if (first[c + 1] > first[c]) hairs[c] = hairs_of(source, first[c], yarns.unit);
        progress.advance(1);
    });
    std::size_t points = 0;
    for (const HairCurves& h : hairs) points += h.points.size();
    if (points > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(ErrorCode::Unsupported,
                    str("flyaway hairs have ", points, " control points (limit 2^32 - 1)"),
                    "lower the yarn's hair density");
    }
    out.points.reserve(points);
    for (HairCurves& h : hairs) {
        const auto base = static_cast<std::uint32_t>(out.points.size());
        out.points.insert(out.points.end(), h.points.begin(), h.points.end());
        for (const std::uint32_t s : h.segments) out.segments.push_back(base + s);
        h = {};
    }
    return out;
}

} // namespace heddle
