#pragma once

#include <heddle/voxelize/chord/fiber_tile.h>
#include <heddle/voxelize/chord/gather_chord.h>
#include <heddle/voxelize/chord/yarn_frame.h>
#include <heddle/yarn/flyaway.h>

#include <cmath>

namespace heddle {

/// Largest sagitta of a chord, in units (subvoxel edges). The ends of chords are moved outwards. In
/// yarns, the mean distance of a chord from its fiber becomes 0 (at most 2/3 of this value), so
/// that the coverage of bundles is unbiased. In single curves they move half as far, so that a
/// chord is as long as its arc and the volume is right. [bench/results/exact.md]
constexpr double kChordSagitta = 1.0 / 2.0;

/// Returns the shape of the section of a yarn's plies.
/// @param yarn  a YarnType or a YarnView
template <typename Yarn>
[[nodiscard]] HEDDLE_HD inline PlySection section_of(const Yarn& yarn) {
    if (yarn.model == YarnModel::Slice) {
        return {0.0f, yarn.model_radius, yarn.model_radius, 1.0f, 0.0f};
    }
    PlySection s{yarn.ply_offset, yarn.ellipse_short, yarn.ellipse_long, 1.0f, 0.0f};
    if (yarn.migration) {
        s.mean = 0.5f * (yarn.migration_max + yarn.migration_min);
        s.amplitude = 0.5f * (yarn.migration_max - yarn.migration_min);
    }
    return s;
}

/// Returns the number of chords for a curve with |P''| <= bend, so that their sagitta is at most
/// kChordSagitta and their length at most a voxel's edge.
/// @param bend    units
/// @param length  upper bound of the curve's length, units
[[nodiscard]] HEDDLE_HD inline int chord_count(double bend, double length, const LatticeUnits& u) {
    const double by_bend = std::sqrt(bend / (8.0 * kChordSagitta));
    const double by_length = length / (u.n > 2 ? static_cast<double>(u.n) : 2.0);
    const double count = std::ceil(by_bend < by_length ? by_length : by_bend);
    return count < 1.0 ? 1 : count > 4096.0 ? 4096 : static_cast<int>(count);
}

/// Returns the number of chords of each of a yarn's fibers along a piece.
/// @param cubic   cubic of the piece
/// @param course  course of the piece
[[nodiscard]] HEDDLE_HD inline int yarn_chord_count(const FiberPiece& piece,
                                                    const LocalCubic& cubic,
                                                    const YarnCourse& course,
                                                    const PlySection& section,
                                                    const LatticeUnits& u) {
    // |P''| of a helix of radius r that turns by w over the piece is r w^2
    const double turn0 = 6.2831853 * std::fabs(course.turns_per_length[0]) * course.length;
    const double turn1 = 6.2831853 * std::fabs(course.turns_per_length[1]) * course.length;
    const double turn2 = 6.2831853 * std::fabs(course.turns_per_length[2]) * course.length;
    const float thick = course.scale0 < course.scale1 ? course.scale1 : course.scale0;
    const float wide =
        section.short_axis < section.long_axis ? section.long_axis : section.short_axis;
    const double all = turn0 + turn1 + (section.amplitude > 0.0f ? turn2 : 0.0);
    const double bend =
        static_cast<double>(cubic.bend()) +
        static_cast<double>(thick) * (static_cast<double>(section.offset) * turn0 * turn0 +
                                      static_cast<double>(wide) * all * all);
    return chord_count(bend, piece.cubic.polygon_length() / u.unit, u);
}

/// How the piece of a single curve joins the pieces before and after it.
struct PlainEnds {
    bool linear = false;      ///< a polyline with the turns below; else a cubic with its tangents
    float turn_before = 0.0f; ///< |difference of directions| / 2 to the span before; 0: none
    float turn_after = 0.0f;
};

/// Returns |difference of directions| / 2 of a linear span and its neighbour; 0 at a free end.
[[nodiscard]] HEDDLE_HD inline float
joint_turn(const CurveSetView& set, const FiberPiece& piece, bool end) {
    const std::uint64_t spans = set.span_count(piece.curve);
    const bool closed = set.is_closed(piece.curve);
    if (end ? piece.part + 1 < piece.parts : piece.part > 0) return 0.0f;
    if (!closed && (end ? piece.span + 1 == spans : piece.span == 0)) return 0.0f;
    const std::uint64_t other = end ? (piece.span + 1) % spans : (piece.span + spans - 1) % spans;
    const Vec3d d =
        normalize(span_cubic(set, piece.curve, other).c[1]) - normalize(piece.cubic.c[1]);
    return static_cast<float>(0.5 * length(d));
}

/// Calls emit(chord) for each chord of the piece of a single curve, from its start to its end.
/// @param count  number of intervals, from chord_count(); intervals without length have no chord
template <typename Emit>
HEDDLE_INLINE void for_each_plain_chord(const LocalCubic& cubic,
                                        const YarnCourse& course,
                                        const PlainEnds& ends,
                                        int count,
                                        Emit&& emit) {
    const auto turn_from = [&](const Chord& chord, float t) {
        return length(chord.dir - normalize(cubic.derivative(t), chord.dir));
    };
    // samples are moved outwards, half as far as in make_chords()
    const float outwards = 1.0f / (24.0f * static_cast<float>(count) * static_cast<float>(count));
    const auto sample = [&](float t) {
        return cubic.at(t) - outwards * cubic.second_derivative(t);
    };
    Vec3f from = sample(0.0f);
    Chord last;
    bool any = false;
    for (int j = 0; j < count; ++j) {
        const float t1 = static_cast<float>(j + 1) / static_cast<float>(count);
        const float tm = (static_cast<float>(j) + 0.5f) / static_cast<float>(count);
        const Vec3f to = sample(t1);
        const Vec3f d = to - from;
        const float len = length(d);
        if (!(len > 0.0f)) continue;
        const float radius = course.scale0 * (1.0f - tm) + course.scale1 * tm;
        Chord next{from, d * (1.0f / len), len, 0.0f, 0.0f, radius < 1e-6f ? 1e-6f : radius};
        if (any) {
            const float bend = 0.5f * length(next.dir - last.dir);
            last.after = bend * last.radius;
            next.before = bend * next.radius;
            emit(last);
        } else {
            next.before = next.radius * (ends.linear ? ends.turn_before : turn_from(next, 0.0f));
        }
        any = true;
        last = next;
        from = to;
    }
    if (!any) return;
    last.after = last.radius * (ends.linear ? ends.turn_after : turn_from(last, 1.0f));
    emit(last);
}

/// Calls emit(chord) for each chord of a piece of the geometry.
/// @param cubic  cubic of the piece
template <typename Emit>
HEDDLE_INLINE void for_each_plain_chord(const FiberView& fibers,
                                        const FiberPiece& piece,
                                        const LocalCubic& cubic,
                                        const LatticeUnits& u,
                                        Emit&& emit) {
    const CurveSetView& set = fibers.sets[piece.set];
    const int count =
        chord_count(static_cast<double>(cubic.bend()), piece.cubic.polygon_length() / u.unit, u);
    PlainEnds ends;
    ends.linear = set.basis == Basis::Linear;
    if (ends.linear) {
        ends.turn_before = joint_turn(set, piece, false);
        ends.turn_after = joint_turn(set, piece, true);
    }
    for_each_plain_chord(cubic, fibers.course(piece, u.unit), ends, count, emit);
}

/// The path of a hair flyaway along a piece of its yarn, as chords.
struct HairPath {
    const LocalCubic& cubic;
    const YarnCourse& course;
    const FlyawayHair& hair;
    SinCos ply;         ///< base angle of the hair's ply
    float ply_offset;   ///< model units
    float fiber_radius; ///< model units

    template <typename Emit>
    HEDDLE_INLINE void for_each_chord(Emit&& emit) const {
        const int count = hair_chord_count(hair, static_cast<double>(course.scale0));
        const double dt = hair.t1 - hair.t0;
        Vec3f from;
        for (int j = 0; j <= count; ++j) {
            const double q = hair.t0 + dt * j / count;
            const double s = hair.z0 + hair.ze * q;
            const auto t = static_cast<float>((s - course.start) / course.length);
            const YarnFrame yarn_at(cubic, course, t);
            const PlyFrame at = yarn_at.of_ply(ply);
            const SinCos turn = sincos_turns((hair.p0 + hair.pe * q) / 6.283185307179586);
            const auto r = static_cast<float>(hair.r0 + hair.re * q);
            const Vec3f to = at.center + (ply_offset + r * turn.cos) * at.u + (r * turn.sin) * at.v;
            const float len = length(to - from);
            if (j > 0 && len > 0.0f) {
                emit(Chord{from, (to - from) * (1.0f / len), len, 0.0f, 0.0f,
                           fiber_radius * yarn_at.scale});
            }
            from = to;
        }
    }
};

} // namespace heddle
