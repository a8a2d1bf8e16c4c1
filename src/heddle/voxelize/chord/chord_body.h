#pragma once

#include <heddle/base/platform.h>
#include <heddle/voxel/lattice_units.h>
#include <heddle/voxel/weight.h>

#include <cstdint>

// The arithmetic of thin chords, for as many chords at once as the lanes L have (lanes_*.h). L has
// the types Real, Int and Mask. The results have the same bits for any number of lanes.

namespace heddle {

/// Returns the shift of a coordinate in a voxel word, x << 20 | y << 10 | z. Adding words adds all
/// three coordinates, and a coordinate outside 0 .. 31 sets its upper bits. A word is valid within
/// 400 voxels of the block.
[[nodiscard]] HEDDLE_HD constexpr int field_shift(int axis) {
    return 20 - 10 * axis;
}
constexpr std::int32_t kFieldOverflow =
    static_cast<std::int32_t>(0xfe000000u) | 0x3e0 << 10 | 0x3e0;

/// Thin chords in units, and intermediate results.
template <typename L>
struct ChordLanes {
    typename L::Real start[3], dir[3];
    typename L::Real length, before, after, radius;
    typename L::Int anchor;    ///< voxel word, relative to the block's lo
    typename L::Mask active;   ///< chords that may intersect the block
    typename L::Int passed[4]; ///< words of the first voxels that the centreline crosses
};

/// Tests which voxel words are inside a block.
template <typename L>
class BlockWords {
public:
    using Int = typename L::Int;

    /// @param size  size of the block, voxels
    HEDDLE_INLINE explicit BlockWords(Vec3i size) {
        std::uint32_t word = 0;
        for (int a = 0; a < 3; ++a) {
            word += static_cast<std::uint32_t>(kBlockVoxels - size[a]) << field_shift(a);
        }
        spare_ = Int(static_cast<std::int32_t>(word));
    }
    [[nodiscard]] HEDDLE_INLINE typename L::Mask holds(Int word) const {
        return ((word | (word + spare_)) & Int(kFieldOverflow)) == Int(0);
    }
    /// Returns the number of a voxel in the block's table.
    [[nodiscard]] HEDDLE_INLINE static Int cell(Int word) {
        return (word & Int(31)) | ((word >> 5) & Int(31 << 5)) | ((word >> 10) & Int(31 << 10));
    }

private:
    Int spare_; ///< 32 minus the block's size, as a voxel word
};

/// Returns the chords whose cylinders may intersect a block.
/// @param anchor  per axis, relative to the block's lo
template <typename L>
[[nodiscard]] HEDDLE_INLINE typename L::Mask meets_block(const ChordLanes<L>& k,
                                                         const typename L::Int (&anchor)[3],
                                                         const LatticeUnits& u,
                                                         Vec3i size) {
    using Real = typename L::Real;
    constexpr float kMargin = 0.01f; // voxels; more than rounding, which depends on the block
    typename L::Mask active = Real(0.0f) < k.length;
    for (int a = 0; a < 3; ++a) {
        const Real p0 = k.start[a] - k.dir[a] * k.before;
        const Real p1 = k.start[a] + k.dir[a] * (k.length + k.after);
        const Real shift = to_real(anchor[a]);
        const Real least = (min(p0, p1) - k.radius) * Real(u.inv_voxel[a]) + shift;
        const Real most = (max(p0, p1) + k.radius) * Real(u.inv_voxel[a]) + shift;
        const Real end(static_cast<float>(size[a]));
        active = active & (Real(-kMargin) < most) & (least < end + Real(kMargin));
    }
    return active;
}

/// Computes the second moment of each chord's directions: d d^T + bend bend^T / 12, as the
/// direction changes by `bend` along the chord, normalized to trace 1.
/// @param out  xx yy zz xy xz yz, 1, 0
template <typename L>
HEDDLE_INLINE void chord_moments(const ChordLanes<L>& k,
                                 const typename L::Real (&bend)[3],
                                 typename L::Real (&out)[8]) {
    using Real = typename L::Real;
    const Real(&d)[3] = k.dir;
    const Real bend2 = bend[0] * bend[0] + bend[1] * bend[1] + bend[2] * bend[2];
    const Real inv = Real(1.0f) / (Real(1.0f) + bend2 * Real(1.0f / 12.0f));
    const Real part = inv * Real(1.0f / 12.0f);
    const auto moment = [&](int a, int b) { return d[a] * d[b] * inv + bend[a] * bend[b] * part; };
    out[0] = moment(0, 0);
    out[1] = moment(1, 1);
    out[2] = moment(2, 2);
    out[3] = moment(0, 1);
    out[4] = moment(0, 2);
    out[5] = moment(1, 2);
    out[6] = Real(1.0f);
    out[7] = Real(0.0f);
}

/// Calls visit(mask, word, length) for each part of the active chords' centrelines within one
/// voxel, and stores the words of the first four voxels in k.passed.
template <typename L, typename Visit>
HEDDLE_INLINE void
for_each_chord_voxel(const LatticeUnits& u, ChordLanes<L>& k, const Visit& visit) {
    using Real = typename L::Real;
    using Int = typename L::Int;
    using Mask = typename L::Mask;
    constexpr float kFar = 1e30f;
    Real next[3]; // axial coordinate at which the centreline leaves its voxel
    Real gap[3];
    Int step[3];
    Int word = k.anchor;
    for (int a = 0; a < 3; ++a) {
        const Real v0 = floor(k.start[a] * Real(u.inv_voxel[a]));
        const Mask forward = Real(0.0f) < k.dir[a];
        const Mask flat = abs(k.dir[a]) < Real(1e-9f);
        const Real inv = Real(1.0f) / k.dir[a];
        const Real border = (v0 + select(forward, Real(1.0f), Real(0.0f))) * Real(u.voxel[a]);
        next[a] = select(flat, Real(kFar), (border - k.start[a]) * inv);
        gap[a] = select(flat, Real(kFar), Real(u.voxel[a]) * abs(inv));
        step[a] = select(forward, Int(1), Int(-1)) << field_shift(a);
        word = word + (to_int(v0) << field_shift(a));
    }
    Real from(0.0f);
    for (Int& passed : k.passed) passed = Int(-1); // outside any block
    Mask open = k.active;
    for (int part = 0; open.bits() != 0; ++part) {
        const Real border = min(min(next[0], next[1]), next[2]);
        const Real to = min(border, k.length);
        const Mask some = from < to;
        if (part < 4) k.passed[part] = select(some, word, Int(-1));
        visit(some & open, word, to - from);
        open = open & (border < k.length);
        for (int a = 0; a < 3; ++a) {
            const Mask crossed = next[a] <= border;
            word = word + select(crossed, step[a], Int(0));
            next[a] = next[a] + select(crossed, gap[a], Real(0.0f));
        }
        from = to;
    }
}

/// The terms of a chord for testing columns, linear in a column's indices (i, j) along the two
/// axes.
template <typename L>
struct ColumnTerms {
    typename L::Real across, across_i, across_j; ///< distance from the axis x sin, units
    typename L::Real axial, axial_i, axial_j;    ///< axial coordinate nearest to the centre line
    typename L::Real r2s2, inv_s2;               ///< (radius sin)^2, 1 / sin^2
    typename L::Real o_depth, d_depth;           ///< depth = o_depth + axial d_depth, units
    typename L::Real axial_enter, inv_d_depth;   ///< end of the axial range with the smallest depth
    typename L::Real depth_range;                ///< depth between the flat ends

    /// Returns the terms with the lanes permuted by `lane`.
    [[nodiscard]] HEDDLE_INLINE ColumnTerms picked(typename L::Int lane) const {
        return {pick(across, lane),     pick(across_i, lane),    pick(across_j, lane),
                pick(axial, lane),      pick(axial_i, lane),     pick(axial_j, lane),
                pick(r2s2, lane),       pick(inv_s2, lane),      pick(o_depth, lane),
                pick(d_depth, lane),    pick(axial_enter, lane), pick(inv_d_depth, lane),
                pick(depth_range, lane)};
    }
};

/// Thin chords seen along one axis. Of the other two, `major` is the axis along which a chord
/// crosses more columns, and `minor` the other one.
template <typename L>
struct ChordProjection {
    typename L::Mask swapped;        ///< major is the second of the two other axes
    typename L::Real first, last;    ///< columns along major
    typename L::Real strip, strip_i; ///< lower edge of the cylinder at column i, as a column j
    typename L::Real width;          ///< width of the cylinder along minor, in columns
    ColumnTerms<L> terms;
};

template <typename L, int kDepth>
[[nodiscard]] HEDDLE_INLINE ChordProjection<L> project_along(const ChordLanes<L>& k,
                                                             const LatticeUnits& u) {
    using Real = typename L::Real;
    using Mask = typename L::Mask;
    constexpr int kA = kDepth == 0 ? 1 : 0;
    constexpr int kB = kDepth == 2 ? 1 : 2;
    ChordProjection<L> v;
    ColumnTerms<L>& t = v.terms;
    v.swapped = abs(k.dir[kA] * Real(u.inv_edge[kA])) < abs(k.dir[kB] * Real(u.inv_edge[kB]));
    const auto pick_axis = [&](Real a, Real b, Real& major, Real& minor) {
        major = select(v.swapped, b, a);
        minor = select(v.swapped, a, b);
    };
    Real dM, dm, oM, om, eM, em, inv_eM, inv_em;
    pick_axis(k.dir[kA], k.dir[kB], dM, dm);
    pick_axis(k.start[kA], k.start[kB], oM, om);
    pick_axis(Real(u.edge[kA]), Real(u.edge[kB]), eM, em);
    pick_axis(Real(u.inv_edge[kA]), Real(u.inv_edge[kB]), inv_eM, inv_em);
    const Real lo = Real(0.0f) - k.before;
    const Real hi = k.length + k.after;
    const Real p0 = oM + dM * lo;
    const Real p1 = oM + dM * hi;
    v.first = ceil((min(p0, p1) - k.radius) * inv_eM - Real(0.5f));
    v.last = floor((max(p0, p1) + k.radius) * inv_eM - Real(0.5f));
    // If the chord is within 1/1000 of the axis direction, it is tilted by 1/1000, so that all
    // quotients are finite. It moves by less than 1/100 subvoxel over a voxel's depth.
    Real s2 = dM * dM + dm * dm;
    const Mask along = s2 < Real(1e-6f);
    dM = select(along, Real(1e-3f), dM);
    dm = select(along, Real(0.0f), dm);
    s2 = max(s2, Real(1e-6f));
    t.inv_s2 = Real(1.0f) / s2;
    t.r2s2 = k.radius * k.radius * s2;
    const Real inv_major = Real(1.0f) / dM;
    const Real qM = Real(0.5f) * eM - oM; // of column (0, 0)
    const Real qm = Real(0.5f) * em - om;
    const Real slope = dm * inv_major * inv_em;
    // slightly wider than the cylinder, so that rounding loses no column; the later test is exact
    const Real half_width = k.radius * abs(sqrt(s2) * inv_major) * inv_em + Real(0.001f);
    v.width = half_width + half_width;
    v.strip = qM * slope - qm * inv_em - half_width;
    v.strip_i = eM * slope;
    t.across = qM * dm - qm * dM;
    t.across_i = eM * dm;
    t.across_j = (Real(0.0f) - em) * dM;
    t.axial = (qM * dM + qm * dm) * t.inv_s2;
    t.axial_i = eM * dM * t.inv_s2;
    t.axial_j = em * dm * t.inv_s2;
    t.o_depth = k.start[kDepth];
    t.d_depth = k.dir[kDepth];
    t.inv_d_depth = Real(1.0f) / select(Real(1e-6f) < abs(t.d_depth), t.d_depth, Real(1e-6f));
    t.axial_enter = select(Real(0.0f) < t.inv_d_depth, lo, hi);
    t.depth_range = abs(t.inv_d_depth) * (hi - lo);
    return v;
}

/// The depths, in units, at which a column's centre line enters and leaves a chord's cylinder.
template <typename L>
struct ColumnDepths {
    typename L::Mask hit;
    typename L::Real enter, leave;
};
template <typename L>
[[nodiscard]] HEDDLE_INLINE ColumnDepths<L>
column_depths(const ColumnTerms<L>& t, typename L::Real i, typename L::Real j) {
    using Real = typename L::Real;
    const Real across = t.across + t.across_i * i + t.across_j * j;
    const Real axial = t.axial + t.axial_i * i + t.axial_j * j;
    const Real disc = t.r2s2 - across * across;
    const Real center = t.o_depth + axial * t.d_depth;
    const Real half = sqrt(max(disc, Real(0.0f))) * t.inv_s2;
    const Real end0 = center + (t.axial_enter - axial) * t.inv_d_depth;
    const Real end1 = end0 + t.depth_range;
    const Real enter = max(center - half, end0);
    const Real leave = min(center + half, end1);
    return {(Real(0.0f) < disc) & (enter < leave), enter, leave};
}

/// The voxels and subvoxels of a column inside a chord's cylinder.
template <typename L, int kDepth>
struct ColumnAddress {
    using Real = typename L::Real;
    using Int = typename L::Int;

    Int base;                 ///< voxel word at depth 0
    Int bit;                  ///< number of the column's bit
    Int depth, last;          ///< first and last voxel along the axis
    Int z0{0}, z1{0}, row{0}; ///< along z: first and last subvoxel; first bit of the voxel's row

    /// @param i, j  column indices along major and minor
    HEDDLE_INLINE ColumnAddress(Int anchor,
                                typename L::Mask swapped,
                                Real i,
                                Real j,
                                const ColumnDepths<L>& at,
                                const LatticeUnits& u,
                                int shift) {
        constexpr int kA = kDepth == 0 ? 1 : 0;
        constexpr int kB = kDepth == 2 ? 1 : 2;
        const Int low((1 << shift) - 1);
        const Int column_i = to_int(i);
        const Int column_j = to_int(j);
        const Int ia = select(swapped, column_j, column_i);
        const Int ib = select(swapped, column_i, column_j);
        base = anchor + ((ia >> shift) << field_shift(kA)) + ((ib >> shift) << field_shift(kB));
        bit = ((ib & low) << shift) | (ia & low);
        const Real inv_voxel(u.inv_voxel[kDepth]);
        depth = to_int(floor(at.enter * inv_voxel));
        last = to_int(floor(at.leave * inv_voxel));
        if constexpr (kDepth == 2) {
            const Real inv_edge(u.inv_edge[2]);
            z0 = to_int(ceil(at.enter * inv_edge - Real(0.5f)));
            z1 = to_int(floor(at.leave * inv_edge - Real(0.5f)));
            row = (((ia & low) << shift) | (ib & low)) << shift;
        }
    }
    /// Returns the subvoxels in the voxel at `depth`: first bit | count << 9.
    [[nodiscard]] HEDDLE_INLINE Int run(int shift) const {
        const Int low((1 << shift) - 1);
        const Int from = max(z0, depth << shift);
        const Int to = min(z1, (depth << shift) + low);
        return row | (from & low) | (max(to - from + Int(1), Int(0)) << 9);
    }
};

/// Returns true for voxels that a chord's centreline crosses, where its direction is already
/// pooled.
template <typename L>
[[nodiscard]] HEDDLE_INLINE typename L::Mask is_passed(const typename L::Int (&passed)[4],
                                                       typename L::Int word) {
    return (word == passed[0]) | (word == passed[1]) | (word == passed[2]) | (word == passed[3]);
}

} // namespace heddle
