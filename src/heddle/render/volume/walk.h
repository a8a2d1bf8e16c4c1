#pragma once

#include <heddle/base/vec.h>
#include <heddle/render/volume/traversal_level.h>

#include <cmath>
#include <cstdint>

namespace heddle {

/// A ray in units of a level's voxels: voxel (i, j, k) is [i, i + 1) and so on.
struct VoxelRay {
    Vec3d origin;
    Vec3d direction; ///< per unit of the ray's t, not of unit length
};

/// A voxel that a ray crosses.
struct VoxelStep {
    const TraversalLeaf& leaf;
    std::int64_t voxel; ///< number in the level's arrays
    Vec3i at;           ///< its index
    float t_in, t_out;  ///< t_in <= t_out
};

namespace detail {

/// A ray relative to the corner of its first voxel: the numbers are small enough for floats.
struct LocalRay {
    Vec3i base;
    Vec3f from;      ///< origin in the first voxel, [0, 1)
    Vec3f direction; ///< per unit of t; no component is 0
    Vec3f per_voxel; ///< 1 / direction
};

[[nodiscard]] inline LocalRay localize(const VoxelRay& ray, float t0) {
    LocalRay out;
    for (int a = 0; a < 3; ++a) {
        const double start = ray.origin[a] + ray.direction[a] * static_cast<double>(t0);
        const double whole = std::floor(start);
        out.base[a] = static_cast<std::int32_t>(whole);
        out.from[a] = static_cast<float>(start - whole);
        const auto d = static_cast<float>(ray.direction[a]);
        constexpr float kMin = 1e-30f; // so slow that no face is reached
        out.direction[a] = std::fabs(d) > kMin ? d : kMin;
        out.per_voxel[a] = 1.0f / out.direction[a];
    }
    return out;
}

/// The face through which a ray leaves the cube [low, low + size).
struct Exit {
    float t;
    int axis;
};

[[nodiscard]] inline Exit find_exit(const LocalRay& ray, Vec3i low, std::int32_t size) {
    const auto plane = [&](std::int32_t l, float d, float from, float per_voxel) {
        return (static_cast<float>(d > 0.0f ? l + size : l) - from) * per_voxel;
    };
    const float x = plane(low.x, ray.direction.x, ray.from.x, ray.per_voxel.x);
    const float y = plane(low.y, ray.direction.y, ray.from.y, ray.per_voxel.y);
    const float z = plane(low.z, ray.direction.z, ray.from.z, ray.per_voxel.z);
    if (x <= y && x <= z) return {x, 0};
    return y <= z ? Exit{y, 1} : Exit{z, 2};
}

/// Returns the index of the first voxel beyond that face.
[[nodiscard]] inline Vec3i step_over(const LocalRay& ray, Vec3i low, std::int32_t size, Exit exit) {
    Vec3i next;
    for (int a = 0; a < 3; ++a) {
        if (a == exit.axis) {
            next[a] = ray.direction[a] > 0.0f ? low[a] + size : low[a] - 1;
            continue;
        }
        const auto i =
            static_cast<std::int32_t>(std::floor(ray.from[a] + ray.direction[a] * exit.t));
        next[a] = i < low[a] ? low[a] : i >= low[a] + size ? low[a] + size - 1 : i;
    }
    return next;
}

} // namespace detail

/// Calls visit(VoxelStep) -> bool for the occupied voxels that a ray crosses between t0 and t1, in
/// order, until it returns false. Skips 64 or 8 empty voxels at a time.
/// @param t0  the point there must be within 2^30 voxels of the lattice's origin
template <typename Visit>
void traverse_voxels(const TraversalLevel& level,
                     const VoxelRay& voxel_ray,
                     float t0,
                     float t1,
                     const Visit& visit) {
    const detail::LocalRay ray = detail::localize(voxel_ray, t0);
    const float end = t1 - t0;
    Vec3i at{};
    float t = 0.0f;
    TraversalLevel::LeafLookup place;
    Vec3i leaf_index{};
    while (t < end) {
        const Vec3i index = ray.base + at;
        const Vec3i leaf_of{index.x >> 3, index.y >> 3, index.z >> 3};
        if (place.leaf == nullptr || !(leaf_of == leaf_index)) {
            place = level.find_leaf(index);
            leaf_index = leaf_of;
        }
        if (place.leaf == nullptr) {
            const std::int32_t mask = ~(place.size - 1);
            const Vec3i low = Vec3i{index.x & mask, index.y & mask, index.z & mask} - ray.base;
            const detail::Exit exit = detail::find_exit(ray, low, place.size);
            at = detail::step_over(ray, low, place.size, exit);
            t = exit.t > t ? exit.t : t;
            continue;
        }
        const detail::Exit exit = detail::find_exit(ray, at, 1);
        const float out = exit.t < end ? (exit.t > t ? exit.t : t) : end;
        const std::int64_t v = place.leaf->find(index);
        if (v >= 0 && !visit(VoxelStep{*place.leaf, v, index, t0 + t, t0 + out})) return;
        at[exit.axis] += ray.direction[exit.axis] > 0.0f ? 1 : -1;
        t = out;
    }
}

} // namespace heddle
