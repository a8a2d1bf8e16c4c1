#pragma once

#include <heddle/base/offset_search.h>
#include <heddle/base/platform.h>
#include <heddle/geom/curves.h>
#include <heddle/yarn/cubic.h>
#include <heddle/yarn/piece_id.h>
#include <heddle/yarn/yarn_view.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace heddle {

/// A piece of a span, no longer than FiberView::piece_length. Pieces are assigned to blocks.
struct FiberPiece {
    std::uint32_t set = 0;  ///< index into Geometry::curves
    std::uint32_t part = 0; ///< number of this part of the span, below `parts`
    std::uint32_t parts = 1;
    std::uint64_t curve = 0;
    std::uint64_t span = 0; ///< number of the span in its curve
    Cubic cubic;            ///< the piece itself
};

/// A yarn's twist and frames along a piece, which its fibers need beside the cubic. Lengths are in
/// model units.
struct YarnCourse {
    double start = 0.0;  ///< yarn length at the piece's start
    double length = 0.0; ///< length of the piece
    double total = 0.0;  ///< length of the whole yarn
    bool closed = false;
    double turns_per_length[3]{}; ///< plies, fibers, migration; whole turns over a closed yarn
    double closing_turns = 0.0;   ///< extra turns over a closed yarn that make its frame close
    Vec3f normal0, normal1;       ///< normals of the yarn frame at the piece's ends
    float scale0 = 1.0f, scale1 = 1.0f; ///< units of course() per model unit, at the ends

    /// Returns the turns of the plies at yarn length `s`, including the closing turns.
    [[nodiscard]] HEDDLE_HD double ply_turns(double s) const {
        const double closing = total > 0.0 ? closing_turns * s / total : 0.0;
        return turns_per_length[0] * s + closing;
    }
};

/// A CurveSet as pointers and numbers, with the data that were computed for its yarns.
struct CurveSetView {
    const Vec3f* points = nullptr;
    const std::uint64_t* first = nullptr; ///< curves + 1
    const std::uint8_t* closed = nullptr; ///< per curve; null: no curve is closed
    const float* radius = nullptr;        ///< per point; null: `default_radius`
    const std::uint32_t* color = nullptr; ///< per point; null: white
    const std::uint64_t* spans = nullptr; ///< curves + 1: first span of each curve in the set
    const double* length = nullptr; ///< arc length at each knot, spans + 1 per curve, scene units;
                                    ///< null: not a yarn of fibers
    const Vec3f* normal = nullptr;  ///< at each knot
    const float* closing = nullptr; ///< closing turns per curve
    std::uint64_t curve_count = 0;
    float default_radius = 0.0f;
    std::uint32_t material = 0;
    Basis basis = Basis::CatmullRom;
    bool has_yarn = false; ///< `yarn` is valid; else each curve is one fiber
    YarnView yarn;

    [[nodiscard]] HEDDLE_HD bool is_closed(std::uint64_t curve) const {
        return closed != nullptr && closed[curve] != 0;
    }
    [[nodiscard]] HEDDLE_HD std::uint64_t span_count(std::uint64_t curve) const {
        return spans[curve + 1] - spans[curve];
    }
    /// Returns the number, in the set, of the control point for radius and colour at knot `k`.
    [[nodiscard]] HEDDLE_HD std::uint64_t knot_point(std::uint64_t curve, std::uint64_t k) const {
        const std::uint64_t begin = first[curve];
        if (is_closed(curve)) return begin + k % (first[curve + 1] - begin);
        return begin + k + (basis == Basis::Linear ? 0u : 1u);
    }
    /// Returns the colour of a piece's span. The set must have colours.
    [[nodiscard]] HEDDLE_HD std::uint32_t color_of(const FiberPiece& piece) const {
        return color[knot_point(piece.curve, piece.span)];
    }
    /// Returns the radius of the curve at the piece's start or end, in scene units.
    [[nodiscard]] HEDDLE_HD double radius_at(const FiberPiece& piece, bool end) const {
        if (has_yarn && yarn.radius > 0.0f) return static_cast<double>(yarn.radius);
        const auto knot = [&](std::uint64_t k) {
            return static_cast<double>(radius == nullptr ? default_radius
                                                         : radius[knot_point(piece.curve, k)]);
        };
        const double t = (piece.part + (end ? 1.0 : 0.0)) / piece.parts;
        return (1.0 - t) * knot(piece.span) + t * knot(piece.span + 1);
    }
    /// Returns the largest distance of the fibers' surfaces from the piece's centreline, scene
    /// units.
    [[nodiscard]] HEDDLE_HD double reach(const FiberPiece& piece) const {
        const double most = std::max(radius_at(piece, false), radius_at(piece, true));
        return has_yarn ? most * static_cast<double>(yarn.reach / yarn.model_radius) : most;
    }
};
static_assert(sizeof(CurveSetView) == 208, "the same on host and device");

/// Returns span `k` of a curve.
[[nodiscard]] HEDDLE_HD inline Cubic
span_cubic(const CurveSetView& set, std::uint64_t curve, std::uint64_t k) {
    const Vec3f* points = set.points + set.first[curve];
    const std::uint64_t n = set.first[curve + 1] - set.first[curve];
    const bool closed = set.is_closed(curve);
    const auto point = [&](std::uint64_t i) { return to_double(points[closed ? i % n : i]); };
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

/// Returns part `part` of a whole span.
[[nodiscard]] HEDDLE_HD inline FiberPiece part_of(const FiberPiece& span, std::uint32_t part) {
    FiberPiece piece = span;
    piece.part = part;
    if (span.parts > 1) {
        const double dt = 1.0 / span.parts;
        piece.cubic = span.cubic.part(part * dt, dt);
    }
    return piece;
}

/// All curves of a geometry as numbered spans: the data of a FiberSource as pointers and numbers.
struct FiberView {
    const CurveSetView* sets = nullptr;
    const std::uint64_t* first_span = nullptr; ///< of each set, and the end
    std::uint64_t set_count = 0;
    std::uint64_t span_count = 0;
    std::uint64_t seed = 0;
    double piece_length = 0.0; ///< scene units; largest length of a piece, up to kMaxParts per span

    /// Returns span `span` (over all sets) as one piece, with the number of parts to divide it
    /// into.
    [[nodiscard]] HEDDLE_HD FiberPiece whole_span(std::uint64_t span) const {
        const std::uint64_t s = range_of(first_span, set_count, span);
        const CurveSetView& set = sets[s];
        const std::uint64_t local = span - first_span[s];
        FiberPiece piece;
        piece.set = static_cast<std::uint32_t>(s);
        piece.curve = range_of(set.spans, set.curve_count, local);
        piece.span = local - set.spans[piece.curve];
        piece.cubic = span_cubic(set, piece.curve, piece.span);
        const double parts = std::ceil(piece.cubic.polygon_length() / (piece_length));
        piece.parts =
            static_cast<std::uint32_t>(std::clamp(parts, 1.0, static_cast<double>(kMaxParts)));
        return piece;
    }
    [[nodiscard]] HEDDLE_HD FiberPiece piece(PieceId id) const {
        return part_of(whole_span(span_of_piece(id)), part_of_piece(id));
    }
    [[nodiscard]] HEDDLE_HD double reach(const FiberPiece& piece) const {
        return sets[piece.set].reach(piece);
    }
    /// Returns the twist and the frames of the yarn along the piece.
    /// @param unit  unit of YarnCourse::scale0 and scale1, scene units
    [[nodiscard]] HEDDLE_HD YarnCourse course(const FiberPiece& piece, double unit) const;
};
static_assert(sizeof(FiberView) == 48, "the same on host and device");

namespace fiber_detail {

/// Sets the turns per length of a yarn's plies, fibers and migration.
HEDDLE_HD inline void set_turns(const YarnView& yarn, YarnCourse& course) {
    double* turns = course.turns_per_length;
    if (yarn.model == YarnModel::Slice) {
        turns[1] = static_cast<double>(yarn.twist) / 6.283185307179586;
    } else {
        const double direction = yarn.fiber_clockwise ? -1.0 : 1.0;
        turns[0] = (yarn.ply_clockwise ? -1.0 : 1.0) / static_cast<double>(yarn.ply_pitch);
        turns[1] = direction / static_cast<double>(yarn.fiber_pitch);
        turns[2] = turns[1] * static_cast<double>(yarn.migration_frequency);
    }
    if (course.closed && course.total > 0.0) {
        for (int i = 0; i < 3; ++i) turns[i] = std::round(turns[i] * course.total) / course.total;
    }
}

} // namespace fiber_detail

HEDDLE_HD inline YarnCourse FiberView::course(const FiberPiece& piece, double unit) const {
    const CurveSetView& set = sets[piece.set];
    YarnCourse course;
    const double r0 = set.radius_at(piece, false);
    const double r1 = set.radius_at(piece, true);
    const double model = set.has_yarn ? static_cast<double>(set.yarn.model_radius) : 1.0;
    course.scale0 = static_cast<float>(r0 / unit / model);
    course.scale1 = static_cast<float>(r1 / unit / model);
    if (set.length == nullptr) return course;

    const std::uint64_t knot = set.spans[piece.curve] + piece.curve; // one knot more than spans
    // twist and hairs are scaled by the radius at the yarn's start, the section by its local radius
    FiberPiece head = piece;
    head.span = 0;
    head.part = 0;
    const double per_scene = model / std::max(set.radius_at(head, false), 1e-300);
    const double s0 = set.length[knot + piece.span];
    const double s1 = set.length[knot + piece.span + 1];
    const double dt = 1.0 / piece.parts;
    course.start = (s0 + (s1 - s0) * dt * piece.part) * per_scene;
    course.length = (s1 - s0) * dt * per_scene;
    course.total = set.length[knot + set.span_count(piece.curve)] * per_scene;
    course.closed = set.is_closed(piece.curve);
    course.closing_turns = static_cast<double>(set.closing[piece.curve]);
    const Vec3f n0 = set.normal[knot + piece.span];
    const Vec3f n1 = set.normal[knot + piece.span + 1];
    const auto t0 = static_cast<float>(dt * piece.part);
    const auto t1 = static_cast<float>(dt * (piece.part + 1));
    course.normal0 = n0 * (1.0f - t0) + n1 * t0;
    course.normal1 = n0 * (1.0f - t1) + n1 * t1;
    fiber_detail::set_turns(set.yarn, course);
    return course;
}

} // namespace heddle
