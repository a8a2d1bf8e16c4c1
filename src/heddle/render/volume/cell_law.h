#pragma once

#include <heddle/render/volume/cell_extinction.h>
#include <heddle/render/volume/cell_walk.h>
#include <heddle/render/volume/fiber_start.h>
#include <heddle/render/volume/traversal_level.h>
#include <heddle/render/volume/walk.h>

#include <algorithm>
#include <cmath>

namespace heddle {

/// Cells: a ray is stopped in the set cells of a voxel, of which 4 x 4 x 4 are known. Along each
/// axis they have the extinction that gives the voxel's coverage; the three combine to the root of
/// the sum of squares.
///
/// Voxels behind each other cover parts of each other, so that a row of them has less extinction
/// than each of them alone. How much less is known of the columns that run along the axis through
/// both. A ray that moves sideways by the share s of a voxel while it crosses one leaves that share
/// of them.
/// @tparam Passage  RayPassage
template <typename Passage>
class CellLaw {
public:
    /// @param start  Ray::from_fiber
    /// @param scale  of the volume instance
    CellLaw(const TraversalLevel& level,
            const VoxelRay& ray,
            const FiberStart& start,
            float scale,
            Passage& passage)
        : level_(level),
          passage_(passage),
          ray_(ray),
          shade_(level, ray, start, scale),
          direction_(to_float(ray.direction)) {
        for (int a = 0; a < 3; ++a) rate_[a] = std::fabs(direction_[a]);
        for (int a = 0; a < 3; ++a) {
            const auto stays = [&](float sideways) {
                return rate_[a] > sideways ? 1.0f - sideways / rate_[a] : 0.0f;
            };
            in_row_[a] = stays(rate_[(a + 1) % 3]) * stays(rate_[(a + 2) % 3]);
        }
    }

    /// @return  false: nothing behind matters
    bool pass(const VoxelStep& step) {
        if (step.t_in <= 0.0f) {
            const float own = shade_.take_own_depth();
            if (own > 0.0f && !passage_.pass_alone(step.t_in, step.t_in, own)) return false;
        }
        const float extinction = extinction_of(level_.extinction(step.voxel));
        return visit_set_cells(level_.cells(step.voxel), inside(step), direction_,
                               step.t_out - step.t_in, [&](float t0, float t1) {
                                   const float from = step.t_in + t0, to = step.t_in + t1;
                                   return passage_.pass_alone(
                                       from, to, shade_.depth_of(from, to, extinction));
                               });
    }

private:
    /// Returns the optical depth per unit of t.
    [[nodiscard]] float extinction_of(const std::array<CellExtinction, 3>& packed) const {
        float square = 0.0f;
        for (int a = 0; a < 3; ++a) {
            const CellExtinction from = packed[static_cast<std::size_t>(a)];
            const float row = 1.0f - in_row_[a] * (1.0f - unpack_in_row(from));
            const float along = unpack_extinction(from) * row * rate_[a];
            square += along * along;
        }
        return std::sqrt(square);
    }
    /// Returns the point where the ray enters the voxel, in [0, 1]^3 of it.
    [[nodiscard]] Vec3f inside(const VoxelStep& step) const {
        const Vec3d at = ray_.origin + ray_.direction * static_cast<double>(step.t_in);
        return to_float(at - Vec3d{static_cast<double>(step.at.x), static_cast<double>(step.at.y),
                                   static_cast<double>(step.at.z)});
    }

    const TraversalLevel& level_;
    Passage& passage_;
    const VoxelRay& ray_;
    StartShade shade_;
    Vec3f direction_;
    Vec3f rate_{};
    Vec3f in_row_{}; ///< per axis: share of the columns in which the ray stays for a voxel
};

} // namespace heddle
