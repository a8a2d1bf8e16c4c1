#include <heddle/render/embree/yarn_path.h>

#include <heddle/yarn/flyaway.h>

namespace heddle {
YarnPath::YarnPath(const FiberSource& source, std::uint64_t first_span, double unit)
    : yarn_(*source.yarn_of(source.whole_span(first_span).set)), unit_(unit) {
    const FiberPiece first = source.whole_span(first_span);
    seed_ = source.seed() + first.set;
    curve_ = first.curve;
    table_ = place_fibers(yarn_, seed_, curve_);
    const CurveSet& set = source.geometry().curves[first.set];
    spans_.reserve(set.span_count(curve_));
    for (std::uint64_t k = 0; k < set.span_count(curve_); ++k) {
        const FiberPiece piece = source.whole_span(first_span + k);
        spans_.push_back({piece.cubic, source.course(piece, unit_)});
    }
    const auto d = [](float x) { return static_cast<double>(x); };
    if (yarn_.model == YarnModel::Slice) {
        short_axis_ = long_axis_ = d(yarn_.model_radius);
        return;
    }
    offset_ = d(yarn_.ply_offset);
    short_axis_ = d(yarn_.ellipse_short);
    long_axis_ = d(yarn_.ellipse_long);
    if (yarn_.migration) {
        mean_ = 0.5 * (d(yarn_.migration_max) + d(yarn_.migration_min));
        amplitude_ = 0.5 * (d(yarn_.migration_max) - d(yarn_.migration_min));
    }
    loops_ = yarn_.flyaways && yarn_.loop_density > 0.0f;
}

TracedYarnFrame YarnPath::at(double t) const {
    const auto count = static_cast<double>(spans_.size());
    if (closed() && t >= count) t -= count; // whole rounds are whole turns of all
    const double k = std::clamp(std::floor(t), 0.0, count - 1.0);
    const Span& span = spans_[static_cast<std::size_t>(k)];
    TracedYarnFrame frame(span.cubic, span.course, t - k);
    frame.scale *= unit_;
    return frame;
}

double YarnPath::knot_of_length(double s) const {
    std::size_t lo = 0;
    std::size_t hi = spans_.size();
    while (hi - lo > 1) {
        const std::size_t mid = (lo + hi) / 2;
        (spans_[mid].course.start <= s ? lo : hi) = mid;
    }
    const YarnCourse& course = spans_[lo].course;
    const double part = course.length > 0.0 ? (s - course.start) / course.length : 0.0;
    return static_cast<double>(lo) + std::clamp(part, 0.0, 1.0);
}

TracedPlyFrame YarnPath::ply(const TracedYarnFrame& at, std::size_t ply) const {
    const SinCos turned = sincos_turns(spans_.front().course.ply_turns(at.s));
    const auto d = [](float x) { return static_cast<double>(x); };
    const double c =
        d(table_.ply_cos[ply]) * d(turned.cos) - d(table_.ply_sin[ply]) * d(turned.sin);
    const double s =
        d(table_.ply_sin[ply]) * d(turned.cos) + d(table_.ply_cos[ply]) * d(turned.sin);
    return {at.center, at.scale * (c * at.normal + s * at.binormal),
            at.scale * (c * at.binormal - s * at.normal)};
}

double YarnPath::loop_factor(std::size_t fiber, double s) const {
    const LoopModel model(yarn_);
    const double frequency =
        static_cast<double>(yarn_.migration_frequency) / static_cast<double>(yarn_.fiber_pitch);
    const double phase = s * frequency + static_cast<double>(table_.migration_turns[fiber]);
    const std::uint64_t id = LoopModel::id(seed_, curve_, fiber);
    const double ratio = model.ratio(id, LoopModel::period_of(phase), table_.radius[fiber]);
    return ratio > 1.0 ? static_cast<double>(LoopModel::factor(ratio, phase)) : 1.0;
}

} // namespace heddle
