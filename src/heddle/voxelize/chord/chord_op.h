#pragma once

#include <heddle/base/bits.h>
#include <heddle/voxelize/chord/chord_body.h>
#include <heddle/voxelize/chord/lanes_one.h>

#include <cstdint>

namespace heddle {

/// A straight piece of fiber with a radius of at most kThickRadius, in units relative to the corner
/// of a voxel.
struct ThinChord {
    Vec3f start;
    Vec3f dir;  ///< unit
    Vec3f bend; ///< change of the fiber's direction along the chord
    float length = 0.0f;
    float before = 0.0f, after = 0.0f; ///< see Chord
    float radius = 0.0f;
};

/// The block that chords are added to.
struct ChordSpace {
    LatticeUnits units;
    Vec3i size; ///< size of the block, voxels
    int shift;  ///< log2 of the subvoxels per axis

    HEDDLE_HD ChordSpace(const LatticeUnits& u, Vec3i block_size)
        : units(u), size(block_size), shift(lowest_bit(static_cast<std::uint32_t>(u.n))) {}
};

namespace chord_detail {

/// Sets the bits of the columns along axis kDepth that the chord covers, and along z of subvoxels.
template <int kDepth, typename Sums>
HEDDLE_HD inline void mark_columns(const ChordLanes<one::Lanes>& k,
                                   const float (&moment)[8],
                                   const ChordSpace& space,
                                   const Sums& sums) {
    using one::Int;
    using one::Real;
    const BlockWords<one::Lanes> block(space.size);
    const ChordProjection<one::Lanes> v = project_along<one::Lanes, kDepth>(k, space.units);
    for (Real i = v.first; (i <= v.last).v; i = i + Real(1.0f)) {
        const Real edge = v.strip + v.strip_i * i;
        const Real end = edge + v.width;
        for (Real j = ceil(edge); (j <= end).v; j = j + Real(1.0f)) {
            const ColumnDepths<one::Lanes> at = column_depths(v.terms, i, j);
            if (!at.hit.v) continue;
            ColumnAddress<one::Lanes, kDepth> place(k.anchor, v.swapped, i, j, at, space.units,
                                                    space.shift);
            for (; place.depth.v <= place.last.v; place.depth = place.depth + Int(1)) {
                const Int word = place.base + (place.depth << field_shift(kDepth));
                if (!block.holds(word).v) continue;
                const int cell = block.cell(word).v;
                sums.or_column(cell, kDepth, std::uint64_t{1} << place.bit.v);
                if constexpr (kDepth == 2) {
                    const auto run = static_cast<std::uint32_t>(place.run(space.shift).v);
                    const std::uint64_t bits = (std::uint64_t{1} << (run >> 9)) - 1;
                    if (bits != 0) {
                        sums.or_subvoxels(cell, static_cast<int>(run >> 6 & 7u),
                                          bits << (run & 63));
                    }
                }
                if (!is_passed<one::Lanes>(k.passed, word).v) sums.pool(cell, moment, kGrazeWeight);
            }
        }
    }
}

/// Pools the chord's direction, weighted by the directed area 2 r length, in a voxel that its
/// centreline crosses.
template <typename Sums>
struct PoolPart {
    const BlockWords<one::Lanes>& block;
    const Sums& sums;
    const float (&moment)[8];
    one::Real width;

    HEDDLE_HD void operator()(one::Mask some, one::Int word, one::Real length) const {
        if (!some.v || !block.holds(word).v) return;
        // short parts have at least the weight of a grazed voxel, so that the voxel has a direction
        sums.pool(block.cell(word).v, moment, max(width * length, one::Real(kGrazeWeight)).v);
    }
};

} // namespace chord_detail

/// Adds a thin chord to the voxels of a block that it intersects. The result has the same bits as
/// that of gather_thin().
/// @param anchor  voxel that the chord's positions are relative to, relative to the block's lo
/// @param sums    has or_column(cell, axis, bits); or_subvoxels(cell, word, bits);
///                pool(cell, moment, weight), units^2; cell = (x 32 + y) 32 + z
template <typename Sums>
HEDDLE_HD inline void
gather_chord_op(const ThinChord& chord, Vec3i anchor, const ChordSpace& space, const Sums& sums) {
    using one::Int;
    using one::Real;
    ChordLanes<one::Lanes> k;
    Real bend[3];
    Int at[3];
    k.anchor = Int(0);
    for (int a = 0; a < 3; ++a) {
        k.start[a] = Real(chord.start[a]);
        k.dir[a] = Real(chord.dir[a]);
        bend[a] = Real(chord.bend[a]);
        at[a] = Int(anchor[a]);
        k.anchor = k.anchor + (at[a] << field_shift(a));
    }
    k.length = Real(chord.length);
    k.before = Real(chord.before);
    k.after = Real(chord.after);
    k.radius = Real(chord.radius);
    k.active = meets_block(k, at, space.units, space.size);
    if (!k.active.v) return;
    Real moments[8];
    chord_moments(k, bend, moments);
    float moment[8];
    for (int m = 0; m < 8; ++m) moment[m] = moments[m].v;
    const BlockWords<one::Lanes> block(space.size);
    const Real width = Real(2.0f) * k.radius;
    for_each_chord_voxel(space.units, k, chord_detail::PoolPart<Sums>{block, sums, moment, width});
    chord_detail::mark_columns<0>(k, moment, space, sums);
    chord_detail::mark_columns<1>(k, moment, space, sums);
    chord_detail::mark_columns<2>(k, moment, space, sums);
}

} // namespace heddle
