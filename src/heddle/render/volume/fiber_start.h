#pragma once

#include <heddle/base/vec.h>
#include <heddle/render/volume/ray.h>
#include <heddle/render/volume/traversal_level.h>
#include <heddle/render/volume/walk.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

// What a ray that leaves a fiber of a volume knows of the cells before it.

namespace heddle {

/// Returns the integral from 0 to x of the share of long cylinders of diameter 1 that a point hits
/// and a second point at a distance of x hits too. The cylinders are perpendicular to the view, and
/// their directions in its plane are random.
[[nodiscard]] inline float integrate_overlap(float x) {
    constexpr float kPi = std::numbers::pi_v<float>;
    if (x <= 1.0f) return x - x * x / kPi;
    // x asin(1 / x) + log(x + r) / 2 - x (x - r) / 2, r = sqrt(x^2 - 1), as a series in 1 / x
    const float inverse = 1.0f / (x * x);
    const float rest =
        0.75f + 0.5f * std::log(2.0f * x) - inverse * (1.0f / 48.0f + inverse / 320.0f);
    return 2.0f / kPi * rest;
}

/// The extinction along a ray that leaves a fiber, compared with the extinction of its cells.
///
/// - The way on which light came to the fiber was free. What blocks the ray near it would have
///   blocked that way too, so it is not there. It is as wide as a blocker: a fiber, or more where
///   fibers are behind fibers (TraversalLevel::crowding).
/// - The fiber that the ray leaves does not stop it: how it shades itself is a part of how it
///   scatters. For one radius the ray is in the fiber. In the rest of the cell where it starts, the
///   extinction of one fiber is left out.
/// - A blocker of many fibers shades itself: of an opaque ball that is seen, the share
///   (1 + cosine) / 2 is lit.
class StartShade {
public:
    /// @param scale  of the volume instance
    StartShade(const TraversalLevel& level,
               const VoxelRay& ray,
               const FiberStart& start,
               float scale) {
        if (!(start.radius > 0.0f)) return;
        const float back = std::clamp(start.cosine, 0.0f, 1.0f);
        const float width = 2.0f * start.radius * level.crowding();
        rate_ = std::sqrt(1.0f - back * back) / width;
        free_ = start.free;
        radius_ = start.radius;
        const float lit = 0.5f * (1.0f + std::clamp(start.cosine, -1.0f, 1.0f));
        own_depth_ = -std::log(lit + (1.0f - lit) * level.bundle_transmittance());
        const Vec3d h = level.info().lattice.voxel_size;
        const auto speed = static_cast<float>(length(ray.direction * h));
        own_extinction_ = 2.0f * start.radius / scale * speed / level.cell_section();
        cell_end_ = find_cell_end(ray);
    }

    /// Returns the optical depth of a part of the ray in set cells.
    [[nodiscard]] float depth_of(float t_in, float t_out, float extinction) const {
        t_in = std::max(t_in, std::min(radius_, t_out));
        const float middle = std::clamp(cell_end_, t_in, t_out);
        float depth = extinction * (unshared(t_out) - unshared(middle));
        if (middle > t_in) {
            depth +=
                std::max(0.0f, extinction - own_extinction_) * (unshared(middle) - unshared(t_in));
        }
        return depth;
    }
    /// Returns the optical depth of the blocker that the ray leaves, at the first call.
    [[nodiscard]] float take_own_depth() { return std::exchange(own_depth_, 0.0f); }

private:
    /// Returns the length of the ray until t that does not share its blockers with the way back.
    [[nodiscard]] float unshared(float t) const {
        const float near = std::min(t, free_);
        const float x = rate_ * near;
        const float shared = x > kLeast ? integrate_overlap(x) / rate_ : near;
        return t - shared;
    }
    /// Returns the t at which a ray leaves the cell of its origin.
    [[nodiscard]] static float find_cell_end(const VoxelRay& ray) {
        double end = std::numeric_limits<float>::max();
        for (int a = 0; a < 3; ++a) {
            const double at = ray.origin[a] * kCells;
            const double share = at - std::floor(at);
            const double rate = ray.direction[a] * kCells;
            if (rate > 0.0) end = std::min(end, (1.0 - share) / rate);
            if (rate < 0.0) end = std::min(end, share / -rate);
        }
        return static_cast<float>(end);
    }

    static constexpr float kLeast = 1e-6f;
    float rate_ = 0.0f; ///< growth of the distance to the way back, in blockers per unit of t
    float free_ = 0.0f;
    float radius_ = 0.0f; ///< of the fiber, within which the ray starts
    float own_depth_ = 0.0f;
    float own_extinction_ = 0.0f;
    float cell_end_ = 0.0f;
};

} // namespace heddle
