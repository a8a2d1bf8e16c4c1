#pragma once

#include <heddle/base/platform.h>
#include <heddle/voxelize/chord/fiber_tile.h>

namespace heddle {

/// A point or vector for each of as many fibers as a Real has lanes (lanes_*.h).
template <typename Real>
struct LanePoint {
    Real x, y, z;

    friend HEDDLE_INLINE LanePoint operator+(LanePoint a, LanePoint b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend HEDDLE_INLINE LanePoint operator-(LanePoint a, LanePoint b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend HEDDLE_INLINE LanePoint operator*(LanePoint a, Real s) {
        return {a.x * s, a.y * s, a.z * s};
    }
    friend HEDDLE_INLINE Real length_of(LanePoint a) {
        return sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
    }
};

/// The constants of a fiber in a FiberTable.
template <typename Real>
struct FiberConstants {
    Real radius, cos_angle, sin_angle, cos_migration, sin_migration;
};

/// Returns the position of a fiber, in units.
/// @param loop  factor of its distance from the ply's axis; null: 1
template <typename Real>
HEDDLE_INLINE LanePoint<Real> fiber_point(const FiberConstants<Real>& fiber,
                                          const PlyFrame& at,
                                          const PlySection& section,
                                          const Real* loop) {
    const Real c = fiber.cos_angle * Real(at.fiber.cos) - fiber.sin_angle * Real(at.fiber.sin);
    const Real s = fiber.sin_angle * Real(at.fiber.cos) + fiber.cos_angle * Real(at.fiber.sin);
    const Real phase =
        fiber.cos_migration * Real(at.migration.cos) - fiber.sin_migration * Real(at.migration.sin);
    Real r = fiber.radius * (Real(section.mean) + Real(section.amplitude) * phase);
    if (loop != nullptr) r = r * *loop;
    const Real px = Real(section.offset) + Real(section.short_axis) * r * c;
    const Real py = Real(section.long_axis) * r * s;
    return {Real(at.center.x) + px * Real(at.u.x) + py * Real(at.v.x),
            Real(at.center.y) + px * Real(at.u.y) + py * Real(at.v.y),
            Real(at.center.z) + px * Real(at.u.z) + py * Real(at.v.z)};
}

/// The end of a chord: a sample, moved outwards by a twelfth of its second difference. A chord
/// between points of the curve is inside the bend, by 2/3 of its sagitta on average. With moved
/// ends its mean distance from the curve is 0.
template <typename Real>
struct ChordEnd {
    LanePoint<Real> at, bend; ///< bend: second difference of the samples
};
template <typename Real>
HEDDLE_INLINE ChordEnd<Real> chord_end(const LanePoint<Real>& before,
                                       const LanePoint<Real>& sample,
                                       const LanePoint<Real>& after) {
    const LanePoint<Real> bend = (after - sample) - (sample - before);
    return {sample - bend * Real(1.0f / 12.0f), bend};
}

/// A Chord without its start, and the change of the fiber's direction along it.
template <typename Real>
struct LaneChord {
    LanePoint<Real> dir, bend;
    Real length, before, after;
};

/// Returns the chord between two ends.
/// @param radius_from, radius_to  radii of the fiber at the ends
template <typename Real>
HEDDLE_INLINE LaneChord<Real> chord_between(const ChordEnd<Real>& from,
                                            const ChordEnd<Real>& to,
                                            float radius_from,
                                            float radius_to) {
    const Real half(0.5f);
    const LanePoint<Real> d = to.at - from.at;
    const Real length = length_of(d);
    const Real inv = select(Real(0.0f) < length, Real(1.0f) / length, Real(0.0f));
    // the wedge on the outer side of each joint, where the direction turns by |bend| / length
    const Real wedge = half * inv;
    return {d * inv, (to.bend + from.bend) * (half * inv), length,
            length_of(from.bend) * (wedge * Real(radius_from)),
            length_of(to.bend) * (wedge * Real(radius_to))};
}

} // namespace heddle
