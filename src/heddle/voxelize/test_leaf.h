#pragma once

#include <heddle/sggx/pack.h>
#include <heddle/sggx/test_lobe.h>
#include <heddle/voxelize/test_voxelize.h>

#include <array>
#include <cmath>
#include <vector>

// Voxels with known fiber directions in them.

namespace heddle::test {

struct DirectionSet {
    const char* name;
    std::vector<Vec3d> directions; ///< unit
};

/// Directions that occur in leaves of yarn and hair, about the z axis.
inline std::vector<DirectionSet> direction_sets() {
    const Vec3d z{0.0, 0.0, 1.0};
    const auto crossed = [&](double angle) {
        return std::vector<Vec3d>{z, {std::sin(angle), 0.0, std::cos(angle)}};
    };
    constexpr double kDegree = 3.141592653589793 / 180.0;
    return {{"aligned bundle", {z}},
            {"two bundles crossed at 90°", crossed(90.0 * kDegree)},
            {"two bundles crossed at 40°", crossed(40.0 * kDegree)},
            {"cone of 20°", cone(z, 20.0 * kDegree, 48)},
            {"cone of 50°", cone(z, 50.0 * kDegree, 48)},
            {"ring", cone(z, 90.0 * kDegree, 48)},
            {"sphere", sphere(96)}};
}

/// Returns the set with a random rotation.
inline std::vector<Vec3d> turned(const std::vector<Vec3d>& directions, CounterRandom& random) {
    const Vec3d x = random_direction(random);
    const Vec3d y = normalize(cross(x, random_direction(random)));
    const Vec3d z = cross(x, y);
    std::vector<Vec3d> out;
    for (const Vec3d& d : directions) out.push_back(x * d.x + y * d.y + z * d.z);
    return out;
}

/// Returns the voxelizer's lobes of voxels that contain one short fiber of each direction.
///
/// @param sets  one per voxel
inline std::vector<Lobe> voxelize_directions(const std::vector<std::vector<Vec3d>>& sets) {
    CurveSet curves;
    curves.basis = Basis::Linear;
    curves.default_radius = 0.01f; // voxels: voxels beside the centreline get no weight
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const Vec3d middle{2.0 * static_cast<double>(i) + 0.5, 0.5, 0.5};
        for (const Vec3d& d : sets[i]) {
            add_curve(curves, {to_float(middle - d * 0.4), to_float(middle + d * 0.4)});
        }
    }
    VoxelizeOptions options;
    options.voxel_size = {1.0, 1.0, 1.0};
    std::vector<Lobe> lobes(sets.size());
    for_each_voxel(*voxelize_now(geometry_of(curves), options), [&](const BlockVoxel& v) {
        if (v.at.y == 0 && v.at.z == 0)
            lobes.at(static_cast<std::size_t>(v.at.x / 2)) = v.lobes()[0];
    });
    return lobes;
}

/// Mean of |w . d|: the projected area by brute force.
inline double mean_cosine(const std::vector<Vec3d>& directions, Vec3d w) {
    double sum = 0.0;
    for (const Vec3d& d : directions) sum += std::fabs(dot(d, w));
    return sum / static_cast<double>(directions.size());
}

} // namespace heddle::test
