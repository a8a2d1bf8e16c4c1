#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>

#include <cmath>
#include <cstdint>

namespace heddle {

// Scan conversion of triangles along the three axes, block by block.
//
// Lattice coordinates are the scene position / subvoxel edge per axis, so that subvoxel (i, j, k)
// spans [i, i + 1) x [j, j + 1) x [k, k + 1). Vertices are snapped to 1 / 4096 of a subvoxel on
// this lattice, so a vertex that two triangles share is the same point for both and for every
// block.
//
// Hits of centre lines are decided in integers. For a row of centres, the two edges that straddle
// it are intersected with it; the hits lie between the first centres at or past the two crossings.
// Each bound depends on one edge only, so two triangles that share an edge have the same bound,
// whatever their orientation. Each line hits exactly one of two triangles at their common edge, and
// a closed mesh is hit an even number of times. This is the top-left rule without orientations.
//
// It is exact for |lattice coordinate| < 2^30: products fit in 64 bits for triangles shorter than
// 2^18 subvoxels; 128 bits are used above. Depth and barycentrics use double + - * only, so they
// have the same bits on every machine, with rounding errors below 1e-12 of the triangle's size.

inline constexpr int kScanFractionBits = 12;
inline constexpr std::int64_t kScanOne = std::int64_t{1} << kScanFractionBits;
inline constexpr std::int64_t kScanHalf = kScanOne / 2;
inline constexpr std::int64_t kScanNarrowLimit = kScanOne << 18; ///< extent of the 64-bit path

/// A box of subvoxel indices, [lo, hi) per axis.
struct SubvoxelBox {
    Vec3i lo;
    Vec3i hi;
};

/// A snapped triangle: coordinate a of vertex v is anchor[a] + p[v][a] / 4096.
struct ScanTriangle {
    std::int32_t anchor[3]; ///< subvoxel that contains the lower corner of the triangle's bounds
    std::int64_t p[3][3];   ///< >= 0
    std::int64_t extent;    ///< upper bound of p
};

namespace scan_detail {

[[nodiscard]] HEDDLE_HD constexpr std::int64_t
least(std::int64_t a, std::int64_t b, std::int64_t c) {
    const std::int64_t d = a < b ? a : b;
    return c < d ? c : d;
}

[[nodiscard]] HEDDLE_HD constexpr std::int64_t
greatest(std::int64_t a, std::int64_t b, std::int64_t c) {
    const std::int64_t d = a > b ? a : b;
    return c > d ? c : d;
}

} // namespace scan_detail

/// Returns the largest integer <= `x`, for |x| < 2^62.
[[nodiscard]] HEDDLE_HD inline std::int64_t floor_to_int(double x) {
    const auto q = static_cast<std::int64_t>(x);
    return q - (static_cast<double>(q) > x ? 1 : 0);
}

/// Returns the lattice coordinates of a scene position.
[[nodiscard]] HEDDLE_HD inline Vec3d to_lattice(Vec3f p, Vec3d subvoxel_size) {
    return {static_cast<double>(p.x) / subvoxel_size.x, static_cast<double>(p.y) / subvoxel_size.y,
            static_cast<double>(p.z) / subvoxel_size.z};
}

/// Snaps a triangle to the scan lattice.
/// @param p0,p1,p2  lattice coordinates, finite, each |coordinate| < 2^30 (checked by voxelize)
[[nodiscard]] HEDDLE_HD inline ScanTriangle prepare_triangle(Vec3d p0, Vec3d p1, Vec3d p2) {
    const double at[3][3] = {{p0.x, p0.y, p0.z}, {p1.x, p1.y, p1.z}, {p2.x, p2.y, p2.z}};
    ScanTriangle t;
    t.extent = 0;
    for (int a = 0; a < 3; ++a) {
        const double one = static_cast<double>(kScanOne);
        const std::int64_t x0 = floor_to_int(at[0][a] * one + 0.5);
        const std::int64_t x1 = floor_to_int(at[1][a] * one + 0.5);
        const std::int64_t x2 = floor_to_int(at[2][a] * one + 0.5);
        const std::int64_t lo = scan_detail::least(x0, x1, x2);
        const std::int64_t cell = lo >> kScanFractionBits;
        const std::int64_t origin = cell * kScanOne;
        t.anchor[a] = static_cast<std::int32_t>(cell);
        t.p[0][a] = x0 - origin;
        t.p[1][a] = x1 - origin;
        t.p[2][a] = x2 - origin;
        t.extent |= t.p[0][a] | t.p[1][a] | t.p[2][a]; // less than twice the largest
    }
    return t;
}

/// Returns the area of a hit along `axis`, in scene units^2: |n_a| x the cross-section of a column.
///
/// Seen along axis a, the triangle has the area |n_a| A, so on average |n_a| A / (column section)
/// centre lines hit it. The weights of all axes add up to A (n_x^2 + n_y^2 + n_z^2) = A.
/// @param normal  unit normal of the triangle, in scene space (not of the lattice)
[[nodiscard]] HEDDLE_HD inline double hit_weight(Vec3d normal, int axis, Vec3d subvoxel_size) {
    const double section = axis == 0   ? subvoxel_size.y * subvoxel_size.z
                           : axis == 1 ? subvoxel_size.z * subvoxel_size.x
                                       : subvoxel_size.x * subvoxel_size.y;
    return std::abs(normal[axis]) * section;
}

/// Returns the unit normal in scene space of a triangle in lattice coordinates; +z if it has no
/// area.
[[nodiscard]] HEDDLE_HD inline Vec3d
scene_normal(Vec3d p0, Vec3d p1, Vec3d p2, Vec3d subvoxel_size) {
    return normalize(cross((p1 - p0) * subvoxel_size, (p2 - p0) * subvoxel_size));
}

namespace scan_detail {

/// Returns the first index whose centre is at or past the coordinate `x` >= 0.
[[nodiscard]] HEDDLE_HD constexpr std::int64_t first_center(std::int64_t x) {
    return (x + kScanHalf - 1) >> kScanFractionBits;
}

/// An edge of the projected triangle from (u, v) to (u + du, v + dv), dv >= 0.
struct RowEdge {
    std::int64_t u, v, du, dv;
    double inverse; ///< 1 / (dv x 4096); infinite if the edge is along a row and crosses none
};

[[nodiscard]] HEDDLE_HD inline RowEdge
make_row_edge(std::int64_t u0, std::int64_t v0, std::int64_t u1, std::int64_t v1) {
    return {u0, v0, u1 - u0, v1 - v0, 1.0 / static_cast<double>((v1 - v0) * kScanOne)};
}

/// Returns the first column with its centre at or past the edge's crossing with row coordinate `y`.
template <typename Int>
[[nodiscard]] HEDDLE_HD inline std::int64_t cross_row(const RowEdge& e, std::int64_t y) {
    const Int number = Int{e.u - kScanHalf} * Int{e.dv} + Int{e.du} * Int{y - e.v};
    const Int unit = Int{e.dv} * Int{kScanOne};
    auto q = static_cast<std::int64_t>(static_cast<double>(number) * e.inverse);
    Int left = number - Int{q} * unit; // corrects the quotient, which is within 1
    for (; left > 0; left -= unit) ++q;
    for (; left <= -unit; left += unit) --q;
    return q;
}

/// The projection of a triangle along one axis, relative to its anchor.
struct AxisScan {
    bool wide; ///< products need 128 bits
    std::int64_t row_mid;
    RowEdge whole, lower, upper; ///< sorted by v; `lower` below row_mid, else `upper`
    std::int64_t u0, v0, du1, dv1, du2, dv2;
    double inverse_area;
    double w0, dw1, dw2, w_lo, w_hi;
    double step1, step2, step_w; ///< steps of b1, b2 and depth per column
};

/// The hits of one row: columns [first, last), with barycentrics and depth at the first.
struct RowSpan {
    std::int64_t first = 0, last = 0;
    double b1 = 0.0, b2 = 0.0, w = 0.0;
};

template <typename Int>
HEDDLE_HD inline RowSpan scan_row_as(const AxisScan& s, std::int64_t row) {
    const std::int64_t y = row * kScanOne + kScanHalf;
    const std::int64_t a = cross_row<Int>(s.whole, y);
    const std::int64_t b = cross_row<Int>(row < s.row_mid ? s.lower : s.upper, y);
    RowSpan span{a < b ? a : b, a < b ? b : a};
    if (span.first == span.last) return span;
    const std::int64_t pu = span.first * kScanOne + kScanHalf - s.u0;
    const std::int64_t pv = y - s.v0;
    const Int e1 = Int{pu} * Int{s.dv2} - Int{pv} * Int{s.du2};
    const Int e2 = Int{pv} * Int{s.du1} - Int{pu} * Int{s.dv1};
    span.b1 = static_cast<double>(e1) * s.inverse_area;
    span.b2 = static_cast<double>(e2) * s.inverse_area;
    span.w = s.w0 + (span.b1 * s.dw1 + span.b2 * s.dw2);
    return span;
}

using Int128 = __int128;

/// Scans a row of a triangle longer than 2^18 subvoxels.
HEDDLE_COLD RowSpan scan_wide_row(const AxisScan& s, std::int64_t row) {
    return scan_row_as<Int128>(s, row);
}

template <typename Int>
[[nodiscard]] HEDDLE_HD inline double twice_area(const AxisScan& s) {
    return static_cast<double>(Int{s.du1} * Int{s.dv2} - Int{s.du2} * Int{s.dv1});
}

/// Sets `s` up for projection along `Axis`; false if the projected triangle has no area.
template <int Axis>
HEDDLE_HD inline bool make_axis_scan(const ScanTriangle& t, AxisScan& s) {
    constexpr int u = Axis == 2 ? 0 : Axis + 1, v = Axis == 0 ? 2 : Axis - 1;
    s.wide = t.extent >= kScanNarrowLimit;
    s.u0 = t.p[0][u], s.v0 = t.p[0][v];
    s.du1 = t.p[1][u] - s.u0, s.dv1 = t.p[1][v] - s.v0;
    s.du2 = t.p[2][u] - s.u0, s.dv2 = t.p[2][v] - s.v0;
    const double area = s.wide ? twice_area<Int128>(s) : twice_area<std::int64_t>(s);
    if (area == 0.0) return false;
    s.inverse_area = 1.0 / area;
    // sort the vertices by v without branches, which would be mispredicted
    const int o0 =
        t.p[1][v] < t.p[0][v] ? (t.p[2][v] < t.p[1][v] ? 2 : 1) : (t.p[2][v] < t.p[0][v] ? 2 : 0);
    const int o2 =
        t.p[1][v] < t.p[0][v] ? (t.p[2][v] < t.p[0][v] ? 0 : 2) : (t.p[2][v] < t.p[1][v] ? 1 : 2);
    const int o1 = 3 - o0 - o2;
    s.row_mid = first_center(t.p[o1][v]);
    s.whole = make_row_edge(t.p[o0][u], t.p[o0][v], t.p[o2][u], t.p[o2][v]);
    s.lower = make_row_edge(t.p[o0][u], t.p[o0][v], t.p[o1][u], t.p[o1][v]);
    s.upper = make_row_edge(t.p[o1][u], t.p[o1][v], t.p[o2][u], t.p[o2][v]);
    // A depth on a subvoxel border belongs to the subvoxel above: the nudge of 2^-20 subvoxels is
    // larger than rounding errors, so planes through lattice points have no noise.
    const double nudge = 0x1p-8;
    const std::int64_t w0 = t.p[0][Axis], w1 = t.p[1][Axis], w2 = t.p[2][Axis];
    s.w_lo = static_cast<double>(least(w0, w1, w2)) + nudge;
    s.w_hi = static_cast<double>(greatest(w0, w1, w2)) + nudge;
    s.w0 = static_cast<double>(w0) + nudge;
    s.dw1 = static_cast<double>(w1 - w0);
    s.dw2 = static_cast<double>(w2 - w0);
    s.step1 = static_cast<double>(s.dv2 * kScanOne) * s.inverse_area;
    s.step2 = -static_cast<double>(s.dv1 * kScanOne) * s.inverse_area;
    s.step_w = s.step1 * s.dw1 + s.step2 * s.dw2;
    return true;
}

/// Skips columns of a long row whose depth is outside [w_lo, w_hi), to save time; no hit is lost.
HEDDLE_HD inline void clip_to_depth(const RowSpan& span,
                                    double step_w,
                                    double w_lo,
                                    double w_hi,
                                    std::int64_t& first,
                                    std::int64_t& last) {
    if (last - first < 16 || step_w == 0.0) return;
    const double a = (w_lo - span.w) / step_w, b = (w_hi - span.w) / step_w;
    const double lo = (a < b ? a : b) - 2.0, hi = (a < b ? b : a) + 2.0; // 2 is far above rounding
    const auto base = static_cast<double>(span.first);
    if (lo + base > static_cast<double>(last) || hi + base < static_cast<double>(first)) {
        last = first;
        return;
    }
    if (lo + base > static_cast<double>(first)) first = floor_to_int(lo + base);
    if (hi + base < static_cast<double>(last)) last = floor_to_int(hi + base) + 1;
}

/// Index ranges [lo, hi) relative to the anchor: of the box, and of its centre lines that the
/// triangle can hit.
struct ScanRange {
    std::int64_t lo[3], hi[3];               ///< of the box
    std::int64_t center_lo[3], center_hi[3]; ///< clipped to the triangle's bounds
};

template <int Axis, typename Hit>
HEDDLE_HD inline void scan_axis(const ScanTriangle& t, const ScanRange& range, Hit& hit) {
    constexpr int u = Axis == 2 ? 0 : Axis + 1, v = Axis == 0 ? 2 : Axis - 1;
    if (range.center_lo[u] >= range.center_hi[u] || range.center_lo[v] >= range.center_hi[v])
        return;
    AxisScan s;
    if (!make_axis_scan<Axis>(t, s)) return;
    const std::int64_t k_lo = range.lo[Axis], k_hi = range.hi[Axis];
    const auto k_count = static_cast<std::uint64_t>(k_hi - k_lo);
    // Copies, so that the compiler does not reload them after each call of `hit`.
    const double w_lo = s.w_lo, w_hi = s.w_hi, step_w = s.step_w;
    const double step1 = s.step1, step2 = s.step2;
    const std::int32_t anchor_u = t.anchor[u], anchor_v = t.anchor[v], anchor_w = t.anchor[Axis];
    for (std::int64_t row = range.center_lo[v]; row < range.center_hi[v]; ++row) {
        const RowSpan span = s.wide ? scan_wide_row(s, row) : scan_row_as<std::int64_t>(s, row);
        std::int64_t first = span.first > range.lo[u] ? span.first : range.lo[u];
        std::int64_t last = span.last < range.hi[u] ? span.last : range.hi[u];
        clip_to_depth(span, step_w, static_cast<double>(k_lo * kScanOne),
                      static_cast<double>(k_hi * kScanOne), first, last);
        const double b1_first = span.b1, b2_first = span.b2, w_first = span.w;
        auto d = static_cast<double>(first - span.first); // counted up exactly
        for (std::int64_t column = first; column < last; ++column, d += 1.0) {
            double w = w_first + d * step_w;
            w = w < w_lo ? w_lo : w;
            w = w > w_hi ? w_hi : w;
            const std::int64_t k = static_cast<std::int64_t>(w) >> kScanFractionBits;
            if (static_cast<std::uint64_t>(k - k_lo) >= k_count) continue;
            std::int32_t at[3];
            at[Axis] = static_cast<std::int32_t>(k) + anchor_w;
            at[u] = static_cast<std::int32_t>(column) + anchor_u;
            at[v] = static_cast<std::int32_t>(row) + anchor_v;
            const auto b1 = static_cast<float>(b1_first + d * step1);
            const auto b2 = static_cast<float>(b2_first + d * step2);
            const float c1 = b1 > 0.0f ? b1 : 0.0f, c2 = b2 > 0.0f ? b2 : 0.0f;
            const float b0 = 1.0f - c1 - c2;
            hit(Axis, at[0], at[1], at[2], b0 > 0.0f ? b0 : 0.0f, c1, c2);
        }
    }
}

} // namespace scan_detail

/// Calls `hit(axis, i, j, k, b0, b1, b2)` for every column centre line that intersects the triangle
/// in a subvoxel (i, j, k) of `box`, for each of the three axes.
///
/// (i, j, k) are global subvoxel indices (std::int32_t) along x, y, z; the one along `axis` (int)
/// is the floor of the depth. b0, b1, b2 (float, >= 0, sum 1) are barycentric coordinates. A hit
/// does not depend on the box. The order is by axis, then row, then column.
template <typename Hit>
HEDDLE_HD inline void scan_triangle(const ScanTriangle& t, const SubvoxelBox& box, Hit&& hit) {
    using namespace scan_detail;
    const std::int32_t box_lo[3] = {box.lo.x, box.lo.y, box.lo.z};
    const std::int32_t box_hi[3] = {box.hi.x, box.hi.y, box.hi.z};
    ScanRange range;
    for (int a = 0; a < 3; ++a) {
        const std::int64_t top = greatest(t.p[0][a], t.p[1][a], t.p[2][a]);
        range.lo[a] = std::int64_t{box_lo[a]} - t.anchor[a];
        range.hi[a] = std::int64_t{box_hi[a]} - t.anchor[a];
        if (range.hi[a] <= 0 || range.lo[a] > top >> kScanFractionBits) return;
        const std::int64_t lo = first_center(least(t.p[0][a], t.p[1][a], t.p[2][a]));
        const std::int64_t hi = first_center(top);
        range.center_lo[a] = lo > range.lo[a] ? lo : range.lo[a];
        range.center_hi[a] = hi < range.hi[a] ? hi : range.hi[a];
    }
    scan_axis<0>(t, range, hit);
    scan_axis<1>(t, range, hit);
    scan_axis<2>(t, range, hit);
}

} // namespace heddle
