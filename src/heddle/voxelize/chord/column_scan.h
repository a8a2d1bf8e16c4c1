#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/trig.h>
#include <heddle/base/vec.h>
#include <heddle/voxel/lattice_units.h>

#include <cmath>
#include <cstdint>

namespace heddle {

/// A cylindrical piece of fiber with flat ends, in units relative to a voxel's corner.
struct Cylinder {
    Vec3f origin; ///< where the axial coordinate is 0
    Vec3f dir;    ///< unit
    float lo = 0; ///< axial range
    float hi = 0;
    float radius = 0;
};

constexpr int kPatch = 16; ///< number of columns tested at once: 4 x 4

/// The depths at which the centre lines of a patch's columns enter and leave the cylinder.
struct PatchDepths {
    float enter[kPatch];
    float leave[kPatch];
};

/// The constants of one cylinder seen along one axis c of a voxel; a and b are the other two.
struct ColumnProjection {
    float oa, ob, oc, da, db, dc;
    float ea, eb; ///< subvoxel edges
    float depth;  ///< voxel edge along c
    float r2s2;   ///< (radius sin)^2, with the angle between cylinder and axis
    float inv_s2; ///< 1 / sin^2
    float lo, hi; ///< axial range

    HEDDLE_INLINE ColumnProjection(const Cylinder& k, const LatticeUnits& u, int a, int b, int c)
        : oa(k.origin[a]),
          ob(k.origin[b]),
          oc(k.origin[c]),
          da(k.dir[a]),
          db(k.dir[b]),
          dc(k.dir[c]),
          ea(u.edge[a]),
          eb(u.edge[b]),
          depth(u.voxel[c]),
          lo(k.lo),
          hi(k.hi) {
        // If the cylinder is within 1/1000 of the axis direction, it is tilted by 1/1000, so that
        // all quotients are finite. It moves by less than 1/100 subvoxel over a voxel's depth.
        float s2 = da * da + db * db;
        if (s2 < 1e-6f) {
            da = 1e-3f;
            db = 0.0f;
            s2 = 1e-6f;
        }
        inv_s2 = 1.0f / s2;
        r2s2 = k.radius * k.radius * s2;
    }
};

/// Finds the columns of 4 x 4 whose centre lines hit the cylinder inside the voxel.
///
/// The line at (a, b) is inside the infinite cylinder between depths z_c -+ half, where z_c is its
/// depth nearest to the axis. It is a hit if this interval, clipped to the voxel's depth, overlaps
/// the axial range [lo, hi].
/// @param a0, b0  the patch's first column
/// @return        bit 4 (b - b0) + (a - a0)
HEDDLE_INLINE std::uint32_t
scan_patch(const ColumnProjection& v, int a0, int b0, PatchDepths* depths) {
    const float base_a = static_cast<float>(a0) + 0.5f;
    const float base_b = static_cast<float>(b0) + 0.5f;
    std::uint32_t hits = 0;
    for (int l = 0; l < kPatch; ++l) {
        const float qa = (base_a + static_cast<float>(l & 3)) * v.ea - v.oa;
        const float qb = (base_b + static_cast<float>(l >> 2)) * v.eb - v.ob;
        const float across = qa * v.db - qb * v.da;
        const float disc = v.r2s2 - across * across;
        const float axial = (qa * v.da + qb * v.db) * v.inv_s2;
        const float center = v.oc + axial * v.dc;
        const float half = std::sqrt(disc > 0.0f ? disc : 0.0f) * v.inv_s2;
        float enter = center - half;
        float leave = center + half;
        enter = enter > 0.0f ? enter : 0.0f;
        leave = leave < v.depth ? leave : v.depth;
        const float axial0 = axial + (enter - center) * v.dc;
        const float axial1 = axial + (leave - center) * v.dc;
        const float axial_min = axial0 < axial1 ? axial0 : axial1;
        const float axial_max = axial0 < axial1 ? axial1 : axial0;
        const bool hit = (disc > 0.0f) & (enter < leave) & (axial_max > v.lo) & (axial_min < v.hi);
        hits |= hit ? 1u << l : 0u;
        if (depths != nullptr) {
            depths->enter[l] = enter;
            depths->leave[l] = leave;
        }
    }
    return hits;
}

/// Returns a patch's 16 bits at their positions in the column mask of a voxel, n columns per axis.
HEDDLE_INLINE std::uint64_t place_patch(std::uint32_t hits, int a0, int b0, int n) {
    if (n < 4) { // only here, some lanes are outside the voxel
        const std::uint32_t row = (1u << n) - 1u;
        std::uint64_t mask = 0;
        for (int b = 0; b < n; ++b) {
            mask |= static_cast<std::uint64_t>((hits >> (4 * b)) & row) << (b * n);
        }
        return mask;
    }
    const std::uint64_t h = hits;
    const std::uint64_t spread =
        n == 4 ? h : (h & 0xf) | (h & 0xf0) << 4 | (h & 0xf00) << 8 | (h & 0xf000) << 12;
    return spread << (b0 * n + a0);
}

/// The columns [first, last] with centres in [lo, hi], clipped to the voxel; empty: last < first.
struct ColumnRange {
    int first, last;
};
HEDDLE_INLINE ColumnRange columns_in(float lo, float hi, float inv_edge, int n) {
    const float limit = static_cast<float>(n);
    float first = lo * inv_edge - 0.5f;
    float last = hi * inv_edge - 0.5f;
    first = first > -1.0f ? first : -1.0f; // so that the conversions below do not overflow
    last = last < limit ? last : limit;
    first = first < limit ? first : limit;
    last = last > -1.0f ? last : -1.0f;
    const int i = -floor_to_int(-first);
    const int j = floor_to_int(last);
    return {i < 0 ? 0 : i, j > n - 1 ? n - 1 : j};
}

/// Returns the column mask of a voxel along axis c, for columns within the ranges.
/// @param on_hit  called for each patch with hits: on_hit(projection, a0, b0, hits, depths)
template <bool kDepths, typename OnHit>
HEDDLE_INLINE std::uint64_t scan_columns(const Cylinder& k,
                                         const LatticeUnits& u,
                                         int c,
                                         const ColumnRange (&range)[3],
                                         OnHit&& on_hit) {
    const int a = c == 0 ? 1 : 0;
    const int b = c == 2 ? 1 : 2;
    const ColumnRange ra = range[a];
    const ColumnRange rb = range[b];
    if (ra.first > ra.last || rb.first > rb.last) return 0;
    const ColumnProjection projection(k, u, a, b, c);
    const int last_base = u.n > 4 ? u.n - 4 : 0;
    std::uint64_t mask = 0;
    for (int b0 = rb.first; b0 <= rb.last; b0 += 4) {
        const int bb = b0 < last_base ? b0 : last_base;
        for (int a0 = ra.first; a0 <= ra.last; a0 += 4) {
            const int aa = a0 < last_base ? a0 : last_base;
            PatchDepths depths;
            const std::uint32_t hits = scan_patch(projection, aa, bb, kDepths ? &depths : nullptr);
            mask |= place_patch(hits, aa, bb, u.n);
            if (kDepths && hits != 0) on_hit(projection, aa, bb, hits, depths);
        }
    }
    return mask;
}

} // namespace heddle
