#pragma once

#include <heddle/base/vec.h>

#include <algorithm>
#include <cmath>

// Cylindrical fibers by their definition, in double: the reference for coverage and volume.

namespace heddle::test {

inline constexpr double kPi = 3.141592653589793;

/// A straight round fiber with flat ends.
struct ExactCylinder {
    Vec3d from, to;
    double radius = 0.0;
};

struct Interval {
    double lo, hi; ///< empty: hi <= lo
};

/// Length of the projection along z of a rectangle of the (s, z) plane cut to depths [z0, z1].
///
/// @param s, z  of its four corners, in order around it
inline double cut_and_project(const double (&s)[4], const double (&z)[4], double z0, double z1) {
    double least = HUGE_VAL;
    double most = -HUGE_VAL;
    const auto take = [&](double at) {
        least = std::min(least, at);
        most = std::max(most, at);
    };
    for (int i = 0; i < 4; ++i) {
        const int j = (i + 1) & 3;
        if (z[i] >= z0 && z[i] <= z1) take(s[i]);
        for (const double plane : {z0, z1}) {
            if ((z[i] < plane) == (z[j] < plane)) continue;
            take(s[i] + (s[j] - s[i]) * (plane - z[i]) / (z[j] - z[i]));
        }
    }
    return most > least ? most - least : 0.0;
}

/// Area of the silhouette, seen along `axis`, of the part of `k` at depths [z0, z1].
///
/// Planes parallel to the fiber and to the view cut it in rectangles, whose silhouettes are exact;
/// across, the midpoint rule over 64 angles: a relative error of 2.5e-5.
inline double silhouette_in_slab(const ExactCylinder& k, int axis, double z0, double z1) {
    constexpr int kCuts = 64; // over half the fiber: it is symmetric
    const Vec3d along = k.to - k.from;
    const double len = length(along);
    const double dz = along[axis] / len;
    const double ds = std::sqrt(std::max(0.0, 1.0 - dz * dz));
    double area = 0.0;
    for (int i = 0; i < kCuts; ++i) {
        const double m = k.radius * std::cos((i + 0.5) * (kPi / 2.0 / kCuts)); // half width
        double s[4];
        double z[4];
        for (int corner = 0; corner < 4; ++corner) {
            const double q = corner == 1 || corner == 2 ? len : 0.0;
            const double p = corner < 2 ? -m : m;
            s[corner] = q * ds - p * dz;
            z[corner] = k.from[axis] + q * dz + p * ds;
        }
        area += 2.0 * m * (kPi / 2.0 / kCuts) * cut_and_project(s, z, z0, z1);
    }
    return area;
}

/// Sum, over all voxels of edge `edge` along `axis`, of the silhouettes of fiber cut by voxel:
/// their faces tile the plane, so a layer of voxels at a time.
inline double sum_of_silhouettes(const ExactCylinder& k, int axis, double edge) {
    const Vec3d d = normalize(k.to - k.from);
    const double end = k.radius * std::sqrt(std::max(0.0, 1.0 - d[axis] * d[axis]));
    const double lo = std::min(k.from[axis], k.to[axis]) - end;
    const double hi = std::max(k.from[axis], k.to[axis]) + end;
    const double inner_lo = std::min(k.from[axis], k.to[axis]) + end; // no flat end between these
    const double inner_hi = std::max(k.from[axis], k.to[axis]) - end;
    double sum = 0.0;
    double inner = -1.0; // layers without an end are all equal
    for (double layer = std::floor(lo / edge); layer * edge < hi; ++layer) {
        const double z0 = layer * edge;
        const double z1 = z0 + edge;
        // a slice tilts by up to `end` beyond its depths, on either side
        const bool is_inner = z0 - end > inner_lo && z1 + end < inner_hi;
        const double area = is_inner && inner >= 0.0 ? inner : silhouette_in_slab(k, axis, z0, z1);
        if (is_inner) inner = area;
        sum += area;
    }
    return sum;
}

/// Depths between which the ray along `axis` at (u, v), the other two axes in ascending order, lies
/// inside `k`.
inline Interval depths_inside(const ExactCylinder& k, int axis, double u, double v) {
    const int iu = axis == 0 ? 1 : 0;
    const int iv = axis == 2 ? 1 : 2;
    const Vec3d along = k.to - k.from;
    const double len = length(along);
    const Vec3d d = along * (1.0 / len);
    const double qu = u - k.from[iu];
    const double qv = v - k.from[iv];
    const double s2 = d[iu] * d[iu] + d[iv] * d[iv];
    const double across = qu * d[iv] - qv * d[iu];
    const double disc = k.radius * k.radius * s2 - across * across;
    if (!(disc > 0.0)) return {0.0, 0.0};
    const double flat = qu * d[iu] + qv * d[iv]; // axial coordinate at depth 0 of `from`
    const double center = flat * d[axis] / s2;
    const double half = std::sqrt(disc) / s2;
    Interval in{center - half, center + half};
    if (std::fabs(d[axis]) > 1e-12) {
        const double end0 = -flat / d[axis];
        const double end1 = (len - flat) / d[axis];
        in = {std::max(in.lo, std::min(end0, end1)), std::min(in.hi, std::max(end0, end1))};
    } else if (flat < 0.0 || flat > len) {
        return {0.0, 0.0};
    }
    return {in.lo + k.from[axis], in.hi + k.from[axis]};
}

} // namespace heddle::test
