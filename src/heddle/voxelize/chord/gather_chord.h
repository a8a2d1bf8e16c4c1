#pragma once

#include <heddle/base/bits.h>
#include <heddle/voxel/sum_fields.h>
#include <heddle/voxel/weight.h>
#include <heddle/voxelize/chord/column_scan.h>

#include <cstdint>

namespace heddle {

/// A straight piece of fiber, in units relative to the corner of the voxel `anchor`.
struct Chord {
    Vec3f start;
    Vec3f dir;        ///< unit
    float length = 0; ///< > 0
    float before = 0; ///< extension of the cylinder before the start, and after the end, which
    float after = 0;  ///< closes the wedge on the outer side of a bend
    float radius = 0; ///< > 0
};

/// Largest radius of a thin fiber, units. The directions of thin fibers are pooled along the
/// centreline, those of thicker fibers over the subvoxels that they fill.
constexpr float kThickRadius = 2.0f;

/// The part of the axial range where the line origin + s dir is inside a voxel grown by `grow`.
struct AxialRange {
    float enter, leave;
};
HEDDLE_INLINE AxialRange
clip_to_voxel(Vec3f origin, Vec3f inv_dir, Vec3f voxel, float grow, AxialRange range) {
    for (int a = 0; a < 3; ++a) {
        const float t0 = (-grow - origin[a]) * inv_dir[a];
        const float t1 = (voxel[a] + grow - origin[a]) * inv_dir[a];
        const float near = t0 < t1 ? t0 : t1;
        const float far = t0 < t1 ? t1 : t0;
        range.enter = near > range.enter ? near : range.enter;
        range.leave = far < range.leave ? far : range.leave;
    }
    return range;
}

/// Clips columns along z at the flat ends of a cylinder.
class FlatEnds {
public:
    HEDDLE_INLINE FlatEnds(const LatticeUnits& u, const ColumnProjection& v) : u_(u), v_(v) {
        const float step = u.edge.z * v.dc; // axial coordinate from one subvoxel to the next
        horizontal_ = step < 1e-6f && step > -1e-6f;
        inv_step_ = 1.0f / (horizontal_ ? 1.0f : step);
    }
    /// Returns the subvoxels of column (x, y) with centres between the ends; empty: last < first.
    HEDDLE_INLINE ColumnRange subvoxels_of(int x, int y) const {
        constexpr ColumnRange kNone{0, -1};
        const auto most = static_cast<float>(u_.n);
        const float qa = (static_cast<float>(x) + 0.5f) * v_.ea - v_.oa;
        const float qb = (static_cast<float>(y) + 0.5f) * v_.eb - v_.ob;
        const float axial =
            qa * v_.da + qb * v_.db + (0.5f * u_.edge.z - v_.oc) * v_.dc; // for subvoxel 0
        if (horizontal_ && (axial < v_.lo || axial > v_.hi)) return kNone;
        const float end0 = horizontal_ ? -1.0f : (v_.lo - axial) * inv_step_;
        const float end1 = horizontal_ ? most : (v_.hi - axial) * inv_step_;
        const float near = end0 < end1 ? end0 : end1;
        const float far = end0 < end1 ? end1 : end0;
        if (!(near < most) || !(far > -1.0f)) return kNone;
        return {-floor_to_int(near > -1.0f ? -near : 1.0f), floor_to_int(far < most ? far : most)};
    }

private:
    const LatticeUnits& u_;
    const ColumnProjection& v_;
    bool horizontal_;
    float inv_step_;
};

/// Sets the bits of the subvoxels with centres in the cylinder: a run in each column of a patch
/// along z.
/// @param sums  has or_subvoxels(cell, word, bits)
/// @return      number of subvoxels in the runs
template <typename Sums>
HEDDLE_INLINE int mark_subvoxels(const Sums& sums,
                                 int cell,
                                 const LatticeUnits& u,
                                 const ColumnProjection& v,
                                 int a0,
                                 int b0,
                                 std::uint32_t hits,
                                 const PatchDepths& depths) {
    const FlatEnds ends(u, v);
    int marked = 0;
    for (; hits != 0; hits &= hits - 1) {
        const int lane = lowest_bit(hits);
        const int x = a0 + (lane & 3);
        const int y = b0 + (lane >> 2);
        if (x >= u.n || y >= u.n) continue;
        const ColumnRange flat = ends.subvoxels_of(x, y);
        if (flat.last < flat.first) continue;
        const ColumnRange z = columns_in(depths.enter[lane], depths.leave[lane], u.inv_edge.z, u.n);
        const int first = z.first > flat.first ? z.first : flat.first;
        const int count = (z.last < flat.last ? z.last : flat.last) - first + 1;
        if (count <= 0) continue;
        const int bit = (x * u.n + y) * u.n + first;
        sums.or_subvoxels(cell, bit >> 6, ((std::uint64_t{1} << count) - 1) << (bit & 63));
        marked += count;
    }
    return marked;
}

/// Adds directions and the fiber's colour to the sums, with a weight in units^2 of at least
/// kGrazeWeight.
/// @param sums    has add_lobe(cell, field, x), see LobeField; has_maps(); add_map(cell, field, x),
///                see MapField
/// @param moment  second moment of the directions, trace 1: xx yy zz xy xz yz
template <typename Sums>
HEDDLE_INLINE void
pool_fiber(const Sums& sums, int cell, const float* moment, float weight, std::uint32_t color) {
    const float w = (weight > kGrazeWeight ? weight : kGrazeWeight) * kWeightScale;
    for (int i = 0; i < 6; ++i) {
        sums.add_lobe(cell, LobeField::Moment + i, static_cast<std::int64_t>(moment[i] * w));
    }
    const auto area = static_cast<std::int64_t>(w);
    sums.add_lobe(cell, LobeField::Weight, area);
    if (!sums.has_maps()) return;
    for (int i = 0; i < 3; ++i) {
        sums.add_map(cell, MapField::Albedo + i, area * ((color >> (8 * i)) & 0xff));
    }
    // fiber materials have no such maps: the factors are 1
    sums.add_map(cell, MapField::Roughness, 255 * area);
    sums.add_map(cell, MapField::Metalness, 255 * area);
    sums.add_map(cell, MapField::Anisotropy, 255 * area);
}

/// The second moment of one direction: xx yy zz xy xz yz.
struct DirectionMoment {
    float v[6];
    HEDDLE_INLINE explicit DirectionMoment(Vec3f d)
        : v{d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.x * d.z, d.y * d.z} {}
};

/// An `on_hit` of scan_columns() that does nothing.
struct IgnoreHits {
    HEDDLE_INLINE void
    operator()(const ColumnProjection&, int, int, std::uint32_t, const PatchDepths&) const {}
};
/// An `on_hit` of scan_columns() that sets the bits of subvoxels and counts them.
template <typename Sums>
struct MarkHits {
    const Sums& sums;
    const LatticeUnits& u;
    int cell;
    int marked = 0;
    HEDDLE_INLINE void operator()(
        const ColumnProjection& v, int a0, int b0, std::uint32_t hits, const PatchDepths& depths) {
        marked += mark_subvoxels(sums, cell, u, v, a0, b0, hits, depths);
    }
};

/// Adds a thick chord to one voxel. `k.origin` is relative to the voxel's corner.
template <typename Sums>
HEDDLE_INLINE void gather_voxel(const Sums& sums,
                                const LatticeUnits& u,
                                const Cylinder& k,
                                float length,
                                Vec3f inv_dir,
                                int cell) {
    const AxialRange reach = clip_to_voxel(k.origin, inv_dir, u.voxel, k.radius, {k.lo, k.hi});
    if (!(reach.enter < reach.leave)) return;
    ColumnRange range[3];
    for (int a = 0; a < 3; ++a) {
        const float p0 = k.origin[a] + k.dir[a] * reach.enter;
        const float p1 = k.origin[a] + k.dir[a] * reach.leave;
        range[a] = columns_in((p0 < p1 ? p0 : p1) - k.radius, (p0 < p1 ? p1 : p0) + k.radius,
                              u.inv_edge[a], u.n);
    }
    const std::uint64_t mx = scan_columns<false>(k, u, 0, range, IgnoreHits{});
    const std::uint64_t my = scan_columns<false>(k, u, 1, range, IgnoreHits{});
    MarkHits<Sums> mark{sums, u, cell};
    const std::uint64_t mz = scan_columns<true>(k, u, 2, range, mark);
    const AxialRange in = clip_to_voxel(k.origin, inv_dir, u.voxel, 0.0f, {0.0f, length});
    const bool passes = in.enter < in.leave;
    if ((mx | my | mz) == 0 && !passes) return;
    if (mx != 0) sums.or_column(cell, 0, mx);
    if (my != 0) sums.or_column(cell, 1, my);
    if (mz != 0) sums.or_column(cell, 2, mz);
    // directed area, the projection 2 r L = (pi r^2 L) x 2 / (pi r), is proportional to the volume
    // of the subvoxels that the chord fills
    const float volume = u.edge.x * u.edge.y * u.edge.z;
    const float weight = 0.63661977f * volume / k.radius * static_cast<float>(mark.marked);
    sums.pool(cell, DirectionMoment(k.dir).v, weight);
}

/// The voxels [lo, hi] of a block.
struct ReachedVoxels {
    Vec3i lo, hi;
};
/// Returns the voxels that the box of a chord's cylinder touches.
/// @param anchor  voxel that the chord's positions are relative to, relative to the block's lo
HEDDLE_INLINE ReachedVoxels voxels_reached(const Chord& chord,
                                           Vec3i anchor,
                                           const LatticeUnits& u,
                                           Vec3i size) {
    ReachedVoxels out;
    for (int a = 0; a < 3; ++a) {
        const float p0 = chord.start[a] - chord.dir[a] * chord.before;
        const float p1 = chord.start[a] + chord.dir[a] * (chord.length + chord.after);
        const float least = ((p0 < p1 ? p0 : p1) - chord.radius) * u.inv_voxel[a];
        const float most = ((p0 < p1 ? p1 : p0) + chord.radius) * u.inv_voxel[a];
        const int lo = floor_to_int(least) + anchor[a];
        const int hi = floor_to_int(most) + anchor[a];
        out.lo[a] = lo > 0 ? lo : 0;
        out.hi[a] = hi < size[a] ? hi : size[a] - 1;
    }
    return out;
}

/// Returns 1 / d per axis, finite also for 0.
HEDDLE_INLINE Vec3f inverse_of(Vec3f d) {
    Vec3f out;
    for (int a = 0; a < 3; ++a) {
        const float safe = d[a] > 1e-12f || d[a] < -1e-12f ? d[a] : 1e-12f;
        out[a] = 1.0f / safe;
    }
    return out;
}

/// Adds a chord thicker than kThickRadius to the voxels of a block that its cylinder intersects.
/// @param sums    has the functions of FiberSums
/// @param size    size of the block, voxels
/// @param anchor  as for voxels_reached()
template <typename Sums>
HEDDLE_INLINE void gather_chord(
    const Sums& sums, const LatticeUnits& u, Vec3i size, const Chord& chord, Vec3i anchor) {
    const Vec3f inv_dir = inverse_of(chord.dir);
    const ReachedVoxels reached = voxels_reached(chord, anchor, u, size);
    for (int x = reached.lo.x; x <= reached.hi.x; ++x) {
        for (int y = reached.lo.y; y <= reached.hi.y; ++y) {
            for (int z = reached.lo.z; z <= reached.hi.z; ++z) {
                const Vec3f corner{static_cast<float>(x - anchor.x) * u.voxel.x,
                                   static_cast<float>(y - anchor.y) * u.voxel.y,
                                   static_cast<float>(z - anchor.z) * u.voxel.z};
                const Cylinder k{chord.start - corner, chord.dir, -chord.before,
                                 chord.length + chord.after, chord.radius};
                gather_voxel(sums, u, k, chord.length, inv_dir,
                             (x * kBlockVoxels + y) * kBlockVoxels + z);
            }
        }
    }
}

} // namespace heddle
