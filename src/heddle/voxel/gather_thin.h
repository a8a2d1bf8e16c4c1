#pragma once

#include <heddle/voxel/gather_chord.h>

namespace heddle {

constexpr int kLanes = 8; ///< columns tested at once along the axis in which a chord advances most

/// A thin chord seen along one axis. `major` is that other axis along which it passes more columns,
/// `minor` the last one. What the test needs is linear in the column's indices (i, j) along them.
struct ThinView {
    int first, last; ///< columns along major
    int tries;       ///< columns along minor that can lie within the radius, for one along major
    float strip, strip_i;           ///< lower edge of the body at column i, in column indices j
    float across, across_i, across_j; ///< distance from the axis x sin, units
    float axial, axial_i, axial_j;    ///< axial coordinate nearest to the centre line, units
    float r2s2, inv_s2;             ///< as in ColumnView
    float o_depth, d_depth;         ///< depth = o_depth + axial d_depth, units
    float axial_enter, inv_d_depth; ///< the end of the axial range at which depth is least
    float depth_range;              ///< depth between the ends, where the flat ends cut

    HEDDLE_INLINE ThinView(const Cylinder& k, const LatticeUnits& u, int major, int minor, int depth) {
        float dM = k.dir[major];
        float dm = k.dir[minor];
        d_depth = k.dir[depth];
        o_depth = k.origin[depth];
        const float p0 = k.origin[major] + dM * k.lo;
        const float p1 = k.origin[major] + dM * k.hi;
        first = -floor_to_int(0.5f - ((p0 < p1 ? p0 : p1) - k.radius) * u.inv_edge[major]);
        last = floor_to_int(((p0 < p1 ? p1 : p0) + k.radius) * u.inv_edge[major] - 0.5f);
        float s2 = dM * dM + dm * dm;
        if (s2 < 1e-6f) { // as in ColumnView: a column as good as along the fiber
            dM = 1e-3f;
            dm = 0.0f;
            s2 = 1e-6f;
        }
        inv_s2 = 1.0f / s2;
        r2s2 = k.radius * k.radius * s2;
        const float inv_major = 1.0f / dM;
        const float qM = 0.5f * u.edge[major] - k.origin[major]; // of column (0, 0)
        const float qm = 0.5f * u.edge[minor] - k.origin[minor];
        const float slope = dm * inv_major * u.inv_edge[minor];
        const float stretch = std::sqrt(s2) * inv_major;
        // a hair wider than the body, so that rounding loses no column; the test itself is exact
        const float width =
            k.radius * (stretch < 0.0f ? -stretch : stretch) * u.inv_edge[minor] + 0.001f;
        tries = static_cast<int>(2.0f * width) + 1;
        strip = qM * slope - qm * u.inv_edge[minor] - width;
        strip_i = u.edge[major] * slope;
        across = qM * dm - qm * dM;
        across_i = u.edge[major] * dm;
        across_j = -u.edge[minor] * dM;
        axial = (qM * dM + qm * dm) * inv_s2;
        axial_i = u.edge[major] * dM * inv_s2;
        axial_j = u.edge[minor] * dm * inv_s2;
        inv_d_depth = 1.0f / (d_depth > 1e-6f || d_depth < -1e-6f ? d_depth : 1e-6f);
        axial_enter = inv_d_depth > 0.0f ? k.lo : k.hi;
        depth_range = (inv_d_depth > 0.0f ? inv_d_depth : -inv_d_depth) * (k.hi - k.lo);
    }
};

/// Columns base + l, l < 8, along major that the chord meets, and where. For hits alone.
struct ThinHits {
    std::uint32_t mask = 0;
    int minor[kLanes];              ///< column index along minor
    int enter[kLanes], leave[kLanes]; ///< first and last voxel along the depth
    int sub_enter[kLanes], sub_leave[kLanes]; ///< first and last subvoxel whose centre is inside
};

template <bool kSubvoxels>
HEDDLE_INLINE void scan_thin(const ThinView& v,
                             int base,
                             int attempt,
                             float inv_voxel,
                             float inv_edge,
                             ThinHits& hits) {
    std::uint32_t mask = 0;
    const auto offset = static_cast<float>(attempt);
    const auto most = static_cast<float>(v.last);
    for (int l = 0; l < kLanes; ++l) {
        const auto i = static_cast<float>(base + l);
        const float j = std::ceil(v.strip + v.strip_i * i) + offset;
        const float across = v.across + v.across_i * i + v.across_j * j;
        const float axial = v.axial + v.axial_i * i + v.axial_j * j;
        const float disc = v.r2s2 - across * across;
        const float center = v.o_depth + axial * v.d_depth;
        const float half = std::sqrt(disc > 0.0f ? disc : 0.0f) * v.inv_s2;
        const float end0 = center + (v.axial_enter - axial) * v.inv_d_depth;
        const float end1 = end0 + v.depth_range;
        const float enter = center - half > end0 ? center - half : end0;
        const float leave = center + half < end1 ? center + half : end1;
        const bool hit = (disc > 0.0f) & (enter < leave) & (i <= most);
        mask |= hit ? 1u << l : 0u;
        hits.minor[l] = static_cast<int>(j);
        hits.enter[l] = static_cast<int>(std::floor(enter * inv_voxel));
        hits.leave[l] = static_cast<int>(std::floor(leave * inv_voxel));
        if constexpr (kSubvoxels) {
            hits.sub_enter[l] = static_cast<int>(std::ceil(enter * inv_edge - 0.5f));
            hits.sub_leave[l] = static_cast<int>(std::floor(leave * inv_edge - 0.5f));
        }
    }
    hits.mask = mask;
}

/// Directed area that a fiber leaves in a voxel that its side alone reaches into, units^2 a column:
/// little beside any centreline's, enough to name a direction where nothing else does.
constexpr float kGrazeWeight = 1.0f / 256.0f;

/// Where a chord's columns go: cells of the block's table, with or without a test against its border.
template <bool kInside>
struct ThinTarget {
    BlockSums& block;
    const LatticeUnits& units;
    const FiberPaint& paint;
    Vec3i anchor; ///< of the chord, relative to the block's lo
    Vec3i size;   ///< of the block
    int shift;    ///< log2 of subvoxels per axis
    int passed[4]; ///< cells that the centreline passes, the first and the last at least
    int passed_count = 0;

    HEDDLE_INLINE bool holds(Vec3i v) const {
        if constexpr (kInside) return true;
        return (static_cast<unsigned>(v.x) < static_cast<unsigned>(size.x)) &
               (static_cast<unsigned>(v.y) < static_cast<unsigned>(size.y)) &
               (static_cast<unsigned>(v.z) < static_cast<unsigned>(size.z));
    }
    HEDDLE_INLINE static int cell(Vec3i v) {
        return (v.x * kBlockVoxels + v.y) * kBlockVoxels + v.z;
    }
    HEDDLE_INLINE bool was_passed(int c) const {
        for (int i = 0; i < passed_count; ++i) {
            if (passed[i] == c) return true;
        }
        return false;
    }
};

/// Pools the chord's direction in the voxels that its centreline passes.
template <bool kInside>
HEDDLE_INLINE void pool_along(ThinTarget<kInside>& t, const Chord& chord) {
    const LatticeUnits& u = t.units;
    Vec3i lo;
    Vec3i hi;
    for (int a = 0; a < 3; ++a) {
        const float p0 = chord.start[a] * u.inv_voxel[a];
        const float p1 = (chord.start[a] + chord.dir[a] * chord.length) * u.inv_voxel[a];
        lo[a] = floor_to_int(p0 < p1 ? p0 : p1);
        hi[a] = floor_to_int(p0 < p1 ? p1 : p0);
    }
    const float area = 2.0f * chord.radius;
    const auto pool = [&](Vec3i at, float length) __attribute__((always_inline)) {
        const Vec3i v = at + t.anchor;
        if (!t.holds(v)) return;
        if (t.passed_count < 4) t.passed[t.passed_count++] = t.cell(v);
        pool_direction(t.block, t.block.voxel(v.x, v.y, v.z), chord.dir, area * length, t.paint);
    };
    if (lo == hi) {
        pool(lo, chord.length);
        return;
    }
    Vec3f inv_dir;
    for (int a = 0; a < 3; ++a) {
        const float d = chord.dir[a];
        inv_dir[a] = 1.0f / (d > 1e-12f || d < -1e-12f ? d : 1e-12f);
    }
    for (int x = lo.x; x <= hi.x; ++x) {
        for (int y = lo.y; y <= hi.y; ++y) {
            for (int z = lo.z; z <= hi.z; ++z) {
                const Vec3f origin = chord.start - Vec3f{static_cast<float>(x) * u.voxel.x,
                                                         static_cast<float>(y) * u.voxel.y,
                                                         static_cast<float>(z) * u.voxel.z};
                const AxialRange in =
                    clip_to_voxel(origin, inv_dir, u.voxel, 0.0f, {0.0f, chord.length});
                if (in.enter < in.leave) pool({x, y, z}, in.leave - in.enter);
            }
        }
    }
}

/// Sets the columns along axis kDepth that the chord meets, and for z the subvoxels.
template <int kDepth, bool kInside>
HEDDLE_INLINE void mark_columns(const ThinTarget<kInside>& t, const Cylinder& k) {
    constexpr int kA = kDepth == 0 ? 1 : 0;
    constexpr int kB = kDepth == 2 ? 1 : 2;
    const LatticeUnits& u = t.units;
    const float step_a = k.dir[kA] * u.inv_edge[kA];
    const float step_b = k.dir[kB] * u.inv_edge[kB];
    const bool swapped = step_a * step_a < step_b * step_b;
    const ThinView view(k, u, swapped ? kB : kA, swapped ? kA : kB, kDepth);
    const int shift = t.shift;
    const int low = (1 << shift) - 1;
    for (int base = view.first; base <= view.last; base += kLanes) {
        for (int attempt = 0; attempt < view.tries; ++attempt) {
            ThinHits hits;
            scan_thin<kDepth == 2>(view, base, attempt, u.inv_voxel[kDepth], u.inv_edge[kDepth], hits);
            for (std::uint32_t mask = hits.mask; mask != 0; mask &= mask - 1) {
                const int l = std::countr_zero(mask);
                const int ia = swapped ? hits.minor[l] : base + l;
                const int ib = swapped ? base + l : hits.minor[l];
                Vec3i v;
                v[kA] = (ia >> shift) + t.anchor[kA];
                v[kB] = (ib >> shift) + t.anchor[kB];
                const std::uint64_t bit = std::uint64_t{1} << (((ib & low) << shift) | (ia & low));
                for (int d = hits.enter[l]; d <= hits.leave[l]; ++d) {
                    v[kDepth] = d + t.anchor[kDepth];
                    if (!t.holds(v)) continue;
                    VoxelSums& voxel = t.block.voxel(v.x, v.y, v.z);
                    voxel.column[kDepth] |= bit;
                    if (!t.was_passed(t.cell(v))) {
                        pool_direction(t.block, voxel, k.dir, kGrazeWeight, t.paint);
                    }
                }
                if constexpr (kDepth == 2) {
                    for (int z = hits.sub_enter[l]; z <= hits.sub_leave[l]; ++z) {
                        v.z = (z >> shift) + t.anchor.z;
                        if (!t.holds(v)) continue;
                        const int sub = ((((ia & low) << shift) | (ib & low)) << shift) | (z & low);
                        t.block.voxel(v.x, v.y, v.z).sub[static_cast<std::size_t>(sub >> 6)] |=
                            std::uint64_t{1} << (sub & 63);
                    }
                }
            }
        }
    }
}

template <bool kInside>
HEDDLE_INLINE void gather_thin_at(ThinTarget<kInside> t, const Chord& chord) {
    pool_along(t, chord);
    const Cylinder k{chord.start, chord.dir, -chord.before, chord.length + chord.after, chord.radius};
    mark_columns<0>(t, k);
    mark_columns<1>(t, k);
    mark_columns<2>(t, k);
}

/// Adds a chord of at most kThickRadius to the voxels that it meets: column by column along the chord,
/// several columns at once, instead of voxel by voxel.
HEDDLE_INLINE void gather_thin(BlockSums& block,
                               const LatticeUnits& u,
                               int shift,
                               const Chord& chord,
                               Vec3i anchor,
                               Vec3i size,
                               const FiberPaint& paint) {
    bool inside = true;
    bool outside = false;
    for (int a = 0; a < 3; ++a) {
        const float p0 = chord.start[a] - chord.dir[a] * chord.before;
        const float p1 = chord.start[a] + chord.dir[a] * (chord.length + chord.after);
        const float least = ((p0 < p1 ? p0 : p1) - chord.radius) * u.inv_voxel[a];
        const float most = ((p0 < p1 ? p1 : p0) + chord.radius) * u.inv_voxel[a];
        const auto begin = static_cast<float>(-anchor[a]);
        const auto end = static_cast<float>(size[a] - anchor[a]);
        inside = inside & (least > begin) & (most < end);
        outside = outside | (most < begin) | (least > end);
    }
    if (outside) return;
    if (inside) {
        gather_thin_at(ThinTarget<true>{block, u, paint, anchor, size, shift, {}, 0}, chord);
    } else {
        gather_thin_at(ThinTarget<false>{block, u, paint, anchor, size, shift, {}, 0}, chord);
    }
}

} // namespace heddle
