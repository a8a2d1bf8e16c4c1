#pragma once

#include <heddle/voxel/plane_slab.h>

#include <cmath>
#include <cstdint>

namespace heddle {

/// The range of a linear function over the part of a voxel between its two planes.
struct SlabRange {
    double min, max;
};

/// Returns the range of dot(direction, p) over the points p of a voxel between its planes, relative
/// to its centre and in units of its edges.
///
/// By duality the maximum is the least of 0.5 sum over the axes |d_a - t g_a| + max(t hi, t lo)
/// over all t, where hi and lo are the planes measured from the centre. That is a convex function
/// of straight parts, so its least value is where two of them meet: at t = 0, where no plane
/// matters, or where t = d_a / g_a. The minimum has the same sums.
/// @param gradient  slab_gradient() of the voxel
[[nodiscard]] HEDDLE_HD inline SlabRange
range_between(Vec3d gradient, const PlaneSlab& slab, Vec3d direction) {
    const double lo = slab.lo - 127.5;
    const double hi = slab.hi - 127.5;
    const double widest =
        0.5 * (std::fabs(direction.x) + std::fabs(direction.y) + std::fabs(direction.z));
    SlabRange out{-widest, widest};
    for (int a = 0; a < 3; ++a) {
        if (gradient[a] == 0.0) continue;
        const double t = direction[a] / gradient[a];
        const double sum = 0.5 * (std::fabs(direction.x - t * gradient.x) +
                                  std::fabs(direction.y - t * gradient.y) +
                                  std::fabs(direction.z - t * gradient.z));
        const double of_hi = t * hi;
        const double of_lo = t * lo;
        const double max = sum + (of_hi > of_lo ? of_hi : of_lo);
        const double min = (of_hi > of_lo ? of_lo : of_hi) - sum;
        out.max = max < out.max ? max : out.max;
        out.min = min > out.min ? min : out.min;
    }
    return out;
}

/// The normal of a parent's slab while it is joined from those of its children, by their areas.
/// Children are added in the order of their octants.
struct ParentNormal {
    double moment[6] = {};

    /// @param hits  occupied subvoxels of the child, which stand for its area
    HEDDLE_HD void add(Vec3d n, std::int64_t hits) {
        const auto weight = static_cast<double>(hits);
        const double products[6] = {n.x * n.x, n.y * n.y, n.z * n.z,
                                    n.x * n.y, n.x * n.z, n.y * n.z};
        for (int i = 0; i < 6; ++i) moment[i] += weight * products[i];
    }
    [[nodiscard]] HEDDLE_HD PackedNormal normal() const {
        const auto at = [&](int i) { return static_cast<float>(moment[i]); };
        return pack_normal(
            to_double(principal_direction({at(0), at(1), at(2), at(3), at(4), at(5)})));
    }
};

/// The slab of a parent while it is joined from those of its children, as they are stored. Each
/// child is rounded by itself, so their order does not matter.
struct ParentSlab {
    Vec3d gradient; ///< slab_gradient() of the parent
    int lo = 255;   ///< above `hi`: no child yet
    int hi = 0;

    /// Makes it hold the part of a child's voxel between the child's planes.
    /// @param octant    number of the child, 4 x + 2 y + z
    /// @param of_child  slab_gradient() of the child
    HEDDLE_HD void add(int octant, Vec3d of_child, const PlaneSlab& slab) {
        const Vec3d center{(octant & 4) != 0 ? 0.25 : -0.25, (octant & 2) != 0 ? 0.25 : -0.25,
                           (octant & 1) != 0 ? 0.25 : -0.25};
        const Vec3d direction = gradient * 0.5; // a child's edges are half of the parent's
        const double middle = slab_value(gradient, center);
        const SlabRange range = range_between(of_child, slab, direction);
        const int top = round_slab_value(middle + range.max);
        const int bottom = round_slab_value(middle + range.min);
        lo = bottom < lo ? bottom : lo;
        hi = top > hi ? top : hi;
    }
    /// @param normal  of the parent: what the gradient was made from
    [[nodiscard]] HEDDLE_HD PlaneSlab slab(PackedNormal normal = {}) const {
        if (lo > hi) return {};
        return {static_cast<std::uint8_t>(lo), static_cast<std::uint8_t>(hi), normal};
    }
};

} // namespace heddle
