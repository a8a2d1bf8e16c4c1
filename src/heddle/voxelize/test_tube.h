#pragma once

#include <heddle/geom/generate.h>
#include <heddle/voxelize/test_isolated.h>
#include <heddle/voxelize/test_voxelize.h>

#include <cmath>
#include <vector>

// Solid yarns, whose volume is section x arc length if they do not intersect themselves.

namespace heddle::test {

/// A point of span `k` of the curve, by the basis' definition.
inline Vec3d point_on(const CurveSet& set, std::size_t curve, std::size_t k, double t) {
    const std::size_t n = set.first[curve + 1] - set.first[curve];
    const std::size_t before = set.is_closed(curve) && set.basis != Basis::Linear ? n - 1 : 0;
    const auto p = [&](std::size_t i) {
        return to_double(set.points[set.first[curve] + (k + before + i) % n]);
    };
    const double u = 1.0 - t;
    switch (set.basis) {
    case Basis::Linear: return p(0) * u + p(1) * t;
    case Basis::CatmullRom:
        return (p(0) * (-t * u * u) + p(1) * (2.0 - 5.0 * t * t + 3.0 * t * t * t) +
                p(2) * (t + 4.0 * t * t - 3.0 * t * t * t) + p(3) * (-t * t * u)) *
               0.5;
    case Basis::CubicBSpline:
        return (p(0) * (u * u * u) + p(1) * (4.0 - 6.0 * t * t + 3.0 * t * t * t) +
                p(2) * (1.0 + 3.0 * t + 3.0 * t * t - 3.0 * t * t * t) + p(3) * (t * t * t)) *
               (1.0 / 6.0);
    }
    return {};
}

/// Length of all curves: 64 chords a span, short by less than 1e-4 of itself for half a turn.
inline double arc_length(const CurveSet& set) {
    double sum = 0.0;
    for (std::size_t c = 0; c < set.curve_count(); ++c) {
        for (std::size_t k = 0; k < set.span_count(c); ++k) {
            Vec3d from = point_on(set, c, k, 0.0);
            for (int i = 1; i <= 64; ++i) {
                const Vec3d to = point_on(set, c, k, i / 64.0);
                sum += length(to - from);
                from = to;
            }
        }
    }
    return sum;
}

/// Makes every curve a solid yarn of this radius.
inline Geometry solid_yarns(CurveSet set, double radius) {
    set.yarn = 0;
    set.radius.clear();
    Geometry geometry = geometry_of(std::move(set));
    YarnType yarn;
    yarn.radius = static_cast<float>(radius);
    geometry.yarns.push_back(yarn);
    return geometry;
}

/// A straight line of length 40 along z.
inline CurveSet line() {
    CurveSet set;
    set.basis = Basis::Linear;
    add_curve(set, {{0.0f, 0.0f, -20.0f}, {0.0f, 0.0f, 20.0f}});
    return set;
}

/// Points of a helix of radius 5 about z.
inline std::vector<Vec3f> helix_points(int first, int last, double per_turn, double pitch) {
    std::vector<Vec3f> points;
    for (int k = first; k <= last; ++k) {
        const double turn = k / per_turn;
        const double phi = 2.0 * kPi * turn;
        points.push_back(to_float(Vec3d{5.0 * std::cos(phi), 5.0 * std::sin(phi), pitch * turn}));
    }
    return points;
}

/// Five turns of a helix of radius 5 and pitch 6.
inline CurveSet helix(int points_per_turn, Basis basis) {
    CurveSet set;
    set.basis = basis;
    // an open cubic's outermost two are tangent points
    add_curve(set, helix_points(-1, 5 * points_per_turn + 1, points_per_turn, 6.0));
    return set;
}

/// A closed circle of radius 5.
inline CurveSet circle(int points, Basis basis) {
    CurveSet set;
    set.basis = basis;
    add_curve(set, helix_points(0, points - 1, points, 0.0), true);
    return set;
}

/// Copies of a set, each turned and moved at random, apart from each other: no lattice direction is
/// favoured.
inline CurveSet scattered(const CurveSet& set, int copies, std::uint64_t seed = 11) {
    Bounds box;
    for (const Vec3f& p : set.points) box.grow(to_double(p));
    const Vec3d middle = (box.lo + box.hi) * 0.5;
    const double apart = 1.5 * length(box.size());
    const int side = static_cast<int>(std::ceil(std::cbrt(copies)));
    CurveSet out;
    out.basis = set.basis;
    out.default_radius = set.default_radius;
    CounterRandom random{seed, 1};
    for (int i = 0; i < copies; ++i) {
        const Vec3d z = random_unit(random);
        const Vec3d x = normalize(cross(z, random_unit(random)));
        const Vec3d y = cross(z, x);
        const Vec3d jitter{static_cast<double>(random.uniform()),
                           static_cast<double>(random.uniform()),
                           static_cast<double>(random.uniform())};
        const Vec3d at = (Vec3d{static_cast<double>(i % side), static_cast<double>(i / side % side),
                                static_cast<double>(i / side / side)} +
                          jitter * 0.1) *
                         apart;
        for (std::size_t c = 0; c < set.curve_count(); ++c) {
            std::vector<Vec3f> points;
            for (std::size_t k = set.first[c]; k < set.first[c + 1]; ++k) {
                const Vec3d p = to_double(set.points[k]) - middle;
                points.push_back(to_float(x * p.x + y * p.y + z * p.z + at));
            }
            add_curve(out, points, set.is_closed(c));
        }
    }
    return out;
}

/// Occupied volume over section x length, less 1, of as many scattered copies as fill about
/// `subvoxel_count` subvoxels.
///
/// @param radius     of the yarns, scene units
/// @param subvoxels  the same in subvoxels: sets the voxel size
inline double
volume_error(const CurveSet& set, double radius, double subvoxels, double subvoxel_count) {
    const double unit = radius / subvoxels;
    const double one = kPi * subvoxels * subvoxels * arc_length(set) / unit;
    const CurveSet all = scattered(set, static_cast<int>(std::ceil(subvoxel_count / one)));
    VoxelizeOptions options;
    options.voxel_size = {8.0 * unit, 8.0 * unit, 8.0 * unit};
    const double found = occupied_volume(*voxelize_now(solid_yarns(all, radius), options));
    const double r = static_cast<double>(static_cast<float>(radius));
    return found / (kPi * r * r * arc_length(all)) - 1.0;
}

} // namespace heddle::test
