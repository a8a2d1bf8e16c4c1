#pragma once

#include <heddle/base/random.h>
#include <heddle/voxelize/test_cylinder.h>
#include <heddle/voxelize/test_isolated.h>
#include <heddle/voxelize/test_voxelize.h>
#include <heddle/yarn/fiber_table.h>

#include <array>
#include <bit>
#include <cmath>
#include <vector>

// Coverage of bundles of fibers, voxel by voxel, against rays through the exact cylinders.

namespace heddle::test {

/// Finds by brute force which of 64 x 64 rays per voxel face and axis hit something in the voxel.
/// Voxels have edge 1.
class RayFaces {
public:
    static constexpr int kRays = 64; ///< per voxel edge
    using Face = std::array<std::uint64_t, kRays>;

    /// Only voxels [lo, hi) are examined.
    RayFaces(Vec3i lo, Vec3i hi) : lo_(lo), size_(hi - lo) {
        faces_.resize(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
                      static_cast<std::size_t>(size_.z));
    }

    void cast(const ExactCylinder& k) {
        for (int axis = 0; axis < 3; ++axis) cast_along(k, axis);
    }

    [[nodiscard]] double covered(Vec3i at, int axis) const {
        int hits = 0;
        for (const std::uint64_t row : faces_[index(at - lo_)][static_cast<std::size_t>(axis)]) {
            hits += std::popcount(row);
        }
        return hits / static_cast<double>(kRays * kRays);
    }
    [[nodiscard]] Vec3i lo() const { return lo_; }
    [[nodiscard]] Vec3i hi() const { return lo_ + size_; }

private:
    [[nodiscard]] std::size_t index(Vec3i at) const {
        return static_cast<std::size_t>((at.x * size_.y + at.y) * size_.z + at.z);
    }

    void cast_along(const ExactCylinder& k, int axis) {
        const int iu = axis == 0 ? 1 : 0;
        const int iv = axis == 2 ? 1 : 2;
        const Vec3d d = normalize(k.to - k.from);
        const auto range = [&](int a) {
            const double end = k.radius * std::sqrt(1.0 - std::min(1.0, d[a] * d[a]));
            return Interval{std::min(k.from[a], k.to[a]) - end, std::max(k.from[a], k.to[a]) + end};
        };
        const Interval us = range(iu);
        const Interval vs = range(iv);
        const double reach = k.radius * std::sqrt(d[iu] * d[iu] + d[iv] * d[iv]);
        for (int j = ray(vs.lo); j <= ray(vs.hi) + 1; ++j) {
            const double v = (j + 0.5) / kRays;
            Interval row = us;
            if (std::fabs(d[iv]) > 1e-9) { // the body's strip on this row
                const double middle = k.from[iu] + (v - k.from[iv]) * d[iu] / d[iv];
                const double half = reach / std::fabs(d[iv]);
                row = {std::max(row.lo, middle - half), std::min(row.hi, middle + half)};
            }
            for (int i = ray(row.lo); i <= ray(row.hi) + 1; ++i) {
                mark(axis, i, j, depths_inside(k, axis, (i + 0.5) / kRays, v));
            }
        }
    }

    static int ray(double x) { return static_cast<int>(std::floor(x * kRays - 0.5)); }

    void mark(int axis, int i, int j, Interval depth) {
        if (!(depth.lo < depth.hi)) return;
        Vec3i at;
        at[axis == 0 ? 1 : 0] = i >> 6;
        at[axis == 2 ? 1 : 2] = j >> 6;
        for (double z = std::floor(depth.lo); z < depth.hi; ++z) {
            at[axis] = static_cast<int>(z);
            const Vec3i v = at - lo_;
            if (v.x < 0 || v.y < 0 || v.z < 0 || v.x >= size_.x || v.y >= size_.y ||
                v.z >= size_.z) {
                continue;
            }
            faces_[index(v)][static_cast<std::size_t>(axis)][static_cast<std::size_t>(j & 63)] |=
                std::uint64_t{1} << (i & 63);
        }
    }

    Vec3i lo_, size_;
    std::vector<std::array<Face, 3>> faces_;
};

/// A bundle as a geometry for the voxelizer, and as cylinders.
struct Bundle {
    Geometry geometry;
    std::vector<ExactCylinder> cylinders;
};

/// The parameters of a bundle; lengths are in subvoxels.
struct BundleOptions {
    double radius = 10.0; ///< radius of the bundle
    double fill = 0.4;    ///< sum of the fibers' sections over the bundle's
    double length = 64.0;
    double slope = 0.15; ///< slope of the outermost fibers to the axis: the twist
    int fibers = 150;
    std::uint64_t seed = 1;
};

/// Straight fibers about a random axis through the origin: a twisted bundle's waist, with a little
/// disorder.
inline Bundle straight_bundle(const BundleOptions& o) {
    CounterRandom random{o.seed, 2};
    const Vec3d axis = random_unit(random);
    const Vec3d x = normalize(cross(axis, random_unit(random)));
    const Vec3d y = cross(axis, x);
    const double unit = 1.0 / 8.0; // of a subvoxel: voxels have edge 1
    CurveSet set;
    set.basis = Basis::Linear;
    set.default_radius = static_cast<float>(o.radius * std::sqrt(o.fill / o.fibers) * unit);
    Bundle bundle;
    const Vec3d shift{static_cast<double>(random.uniform()), static_cast<double>(random.uniform()),
                      static_cast<double>(random.uniform())};
    for (int f = 0; f < o.fibers; ++f) {
        const double r = std::sqrt(static_cast<double>(random.uniform()));
        const double phi = 2.0 * kPi * static_cast<double>(random.uniform());
        const Vec3d out = x * std::cos(phi) + y * std::sin(phi);
        const Vec3d around = y * std::cos(phi) - x * std::sin(phi);
        const Vec3d stray = random_unit(random) * 0.03;
        const Vec3d d = normalize(axis + around * (o.slope * r) + stray);
        const Vec3d p = out * (r * o.radius * unit) + shift;
        const Vec3d half = d * (0.5 * o.length * unit);
        add_curve(set, {to_float(p - half), to_float(p + half)});
        bundle.cylinders.push_back({to_double(set.points[set.points.size() - 2]),
                                    to_double(set.points.back()),
                                    static_cast<double>(set.default_radius)});
    }
    bundle.geometry = geometry_of(std::move(set));
    return bundle;
}

/// A yarn of one ply about its own axis, whose fibers fill its section as `o` says. Model radius 1.
inline YarnType one_ply_yarn(const BundleOptions& o) {
    YarnType yarn;
    yarn.name = "bundle";
    yarn.model = YarnModel::Procedural;
    yarn.radius = static_cast<float>(o.radius / 8.0);
    yarn.fiber_radius = static_cast<float>(std::sqrt(o.fill / o.fibers));
    yarn.fibers_per_ply = o.fibers;
    yarn.fiber_pitch = static_cast<float>(2.0 * kPi / o.slope);
    yarn.ply_pitch = 1e6f; // it turns with its fibers alone
    return yarn;
}

/// Appends the helices of a yarn on a straight centreline, in cylinders of a quarter of a subvoxel.
inline void
add_helices(std::vector<ExactCylinder>& cylinders, const YarnType& yarn, Vec3d from, Vec3d to) {
    const FiberTable table = place_fibers(yarn, 0, 0); // seed 0, the first yarn
    const double len = length(to - from);
    const Vec3d t = normalize(to - from);
    const Vec3d u = to_double(any_perpendicular(to_float(t))); // where a yarn's frame starts
    const Vec3d v = cross(t, u);
    const auto R = static_cast<double>(yarn.radius);
    const int steps = static_cast<int>(32.0 * len);
    for (std::size_t f = 0; f < table.size(); ++f) {
        const double r = R * static_cast<double>(table.radius[f]);
        const double start = std::atan2(static_cast<double>(table.sin_angle[f]),
                                        static_cast<double>(table.cos_angle[f]));
        const auto at = [&](int step) {
            const double s = len * step / steps;
            const double phi = start + 2.0 * kPi * s / R / static_cast<double>(yarn.fiber_pitch);
            return from + t * s + u * (r * std::cos(phi)) + v * (r * std::sin(phi));
        };
        for (int i = 0; i < steps; ++i) {
            cylinders.push_back({at(i), at(i + 1), R * static_cast<double>(yarn.fiber_radius)});
        }
    }
}

/// A twisted yarn on a straight centreline, expanded to fibers by the voxelizer.
inline Bundle yarn_bundle(const BundleOptions& o) {
    CounterRandom random{o.seed, 3};
    const Vec3d half = random_unit(random) * (0.5 * o.length / 8.0);
    const Vec3d shift{static_cast<double>(random.uniform()), static_cast<double>(random.uniform()),
                      static_cast<double>(random.uniform())};
    CurveSet set;
    set.basis = Basis::Linear;
    set.yarn = 0;
    add_curve(set, {to_float(shift - half), to_float(shift + half)});
    Bundle bundle;
    const YarnType yarn = one_ply_yarn(o);
    add_helices(bundle.cylinders, yarn, to_double(set.points[0]), to_double(set.points[1]));
    bundle.geometry = geometry_of(std::move(set));
    bundle.geometry.yarns.push_back(yarn);
    return bundle;
}

/// Differences of coverage over voxels and axes.
struct BundleError {
    double sum = 0.0, absolute = 0.0, square = 0.0;
    double exact = 0.0; ///< sum of the true coverage
    std::int64_t faces = 0;

    void add(double found, double truth) {
        const double d = found - truth;
        sum += d;
        absolute += std::fabs(d);
        square += d * d;
        exact += truth;
        ++faces;
    }
    [[nodiscard]] double bias() const { return sum / static_cast<double>(faces); }
    [[nodiscard]] double mean_absolute() const { return absolute / static_cast<double>(faces); }
    [[nodiscard]] double mean_coverage() const { return exact / static_cast<double>(faces); }
};

/// Rays through a bundle, for comparing any number of voxelizations.
inline RayFaces cast_rays(const Bundle& bundle) {
    Vec3d lo{HUGE_VAL, HUGE_VAL, HUGE_VAL};
    Vec3d hi{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (const ExactCylinder& k : bundle.cylinders) {
        for (int a = 0; a < 3; ++a) {
            lo[a] = std::min({lo[a], k.from[a] - k.radius, k.to[a] - k.radius});
            hi[a] = std::max({hi[a], k.from[a] + k.radius, k.to[a] + k.radius});
        }
    }
    const auto corner = [](double x, int more) { return static_cast<int>(std::floor(x)) + more; };
    RayFaces rays({corner(lo.x, -1), corner(lo.y, -1), corner(lo.z, -1)},
                  {corner(hi.x, 2), corner(hi.y, 2), corner(hi.z, 2)});
    for (const ExactCylinder& k : bundle.cylinders) rays.cast(k);
    return rays;
}

/// Adds every voxel that the rays or the voxelizer find occupied.
inline void compare(const VoxelLevel& found, const RayFaces& rays, BundleError& error) {
    const Vec3i lo = rays.lo();
    const Vec3i size = rays.hi() - lo;
    std::vector<Vec3d> coverage(static_cast<std::size_t>(size.x * size.y * size.z),
                                Vec3d{-1.0, -1.0, -1.0});
    const auto index = [&](Vec3i at) {
        const Vec3i v = at - lo;
        return static_cast<std::size_t>((v.x * size.y + v.y) * size.z + v.z);
    };
    for_each_voxel(found, [&](const BlockVoxel& v) {
        coverage.at(index(v.at)) = {covered(v.coverage(), 0), covered(v.coverage(), 1),
                                    covered(v.coverage(), 2)};
    });
    for (int x = lo.x; x < rays.hi().x; ++x) {
        for (int y = lo.y; y < rays.hi().y; ++y) {
            for (int z = lo.z; z < rays.hi().z; ++z) {
                const Vec3i at{x, y, z};
                const Vec3d c = coverage[index(at)];
                const Vec3d truth{rays.covered(at, 0), rays.covered(at, 1), rays.covered(at, 2)};
                if (c.x < 0.0 && truth == Vec3d{}) continue;
                for (int a = 0; a < 3; ++a) error.add(std::max(0.0, c[a]), truth[a]);
            }
        }
    }
}

} // namespace heddle::test
