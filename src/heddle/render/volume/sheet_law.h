#pragma once

#include <heddle/render/volume/sheet_voxel.h>
#include <heddle/render/volume/transport.h>
#include <heddle/render/volume/traversal_level.h>
#include <heddle/render/volume/walk.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

// Sheet: how a ray passes the voxels of surfaces. docs/transport.md, "Walls".

namespace heddle {

/// The sheet that a ray met last. In the next voxel it tells on which side of that voxel's sheet
/// the ray is, if both are parts of one surface.
struct LastSheet {
    Vec3f normal{};         ///< of its slab
    float height = 0.0f;    ///< of the ray above the sheet at t
    float slope = 0.0f;     ///< growth of the height per unit of t
    float t = 0.0f;         ///< where the ray left its voxel
    float thickness = 0.0f; ///< of its slab, and of the rounding
    int side = 0; ///< of the sheet that the ray is on: 1 above, -1 below; 0: no last sheet
};

namespace detail {

/// A voxel's sheet in the object's space, heights from the voxel's center.
struct PlacedSheet {
    Vec3f normal;    ///< unit
    Vec3f gradient;  ///< change of the height along each edge of the voxel
    float at;        ///< height of the sheet
    float thickness; ///< of the slab, and of the rounding
};

/// @param edges  of the voxel
/// @param share  Ray::sheet: height of the sheet within the slab, 0 to 1
[[nodiscard]] inline PlacedSheet place_sheet(const SheetVoxel& voxel, Vec3f edges, float share) {
    PlacedSheet out;
    out.normal = Vec3f{static_cast<float>(voxel.normal[0]), static_cast<float>(voxel.normal[1]),
                       static_cast<float>(voxel.normal[2])} *
                 (1.0f / 32767.0f);
    out.gradient = out.normal * edges;
    const float half =
        0.5f * (std::fabs(out.gradient.x) + std::fabs(out.gradient.y) + std::fabs(out.gradient.z));
    const float step = half * (2.0f / 255.0f);
    const auto lo = static_cast<float>(voxel.lo);
    const auto hi = static_cast<float>(voxel.hi);
    out.at = (lo + share * (hi - lo)) * step - half;
    out.thickness = (hi - lo + 1.0f) * step;
    return out;
}

} // namespace detail

/// Sheet: a voxel's surface is a plane at an unknown height in the voxel's slab. All voxels have
/// theirs at the same share of the slab, which the ray carries, so neighbouring planes are near
/// each other. The ray is stopped where it crosses the plane, with the probability that the surface
/// has no hole there. What else is in the voxel stops it as in Product.
template <typename Passage>
class SheetLaw {
public:
    /// @param share  Ray::sheet
    /// @param start  the voxel on whose sheet the ray starts; -1: none
    SheetLaw(const TraversalLevel& level,
             const VoxelRay& ray,
             float share,
             std::int64_t start,
             Passage& passage)
        : level_(level),
          passage_(passage),
          ray_(ray),
          edges_(to_float(level.info().lattice.voxel_size)),
          direction_(to_float(ray.direction)),
          speed_(length(direction_ * edges_)),
          longest_(std::max({edges_.x, edges_.y, edges_.z})),
          share_(share),
          start_(start) {}

    /// @return  false: nothing behind matters
    bool pass(const VoxelStep& step) {
        const SheetVoxel& voxel = level_.sheet(step.voxel);
        if (voxel.depth == 0) return pass_rest(step, voxel, step.t_in, step.t_out);
        const detail::PlacedSheet sheet = detail::place_sheet(voxel, edges_, share_);
        const float slope = dot(sheet.gradient, direction_);
        const float in = dot(sheet.gradient, inside(step, step.t_in)) - sheet.at;
        const float out = in + slope * (step.t_out - step.t_in);
        LastSheet& last = passage_.last_sheet();
        const int side_out = out < 0.0f ? -1 : 1;
        const int side = step.voxel == start_ ? side_out : side_of(step, sheet, in);
        const bool crosses = side != side_out;
        const float t = crosses ? crossing(step, in, slope, side) : step.t_out;
        if (!pass_rest(step, voxel, step.t_in, t)) return false;
        if (crosses) {
            const float depth = static_cast<float>(voxel.depth) * kDepthUnit;
            const bool opaque = voxel.depth == kOpaqueSheet;
            if (!passage_.pass_sheet(t, opaque ? 1e30f : depth, side)) return false;
            if (!pass_rest(step, voxel, t, step.t_out)) return false;
        }
        const bool starts = step.voxel == start_ && last.side != 0;
        last = {
            sheet.normal, out, slope, step.t_out, sheet.thickness, starts ? last.side : side_out};
        if (crosses) last.side = 0; // through a hole: neighbours may have the rest of the surface
        return true;
    }

private:
    [[nodiscard]] bool
    pass_rest(const VoxelStep& step, const SheetVoxel& voxel, float t_in, float t_out) {
        if ((voxel.rest[0] | voxel.rest[1] | voxel.rest[2]) == 0) return true;
        const Vec3f depth =
            Vec3f{static_cast<float>(voxel.rest[0]), static_cast<float>(voxel.rest[1]),
                  static_cast<float>(voxel.rest[2])} *
            kDepthUnit;
        return passage_.pass_alone({step.leaf, step.voxel, step.at, t_in, t_out},
                                   combine_depths(depth * direction_ * (t_out - t_in)));
    }
    /// Returns the point of the ray at t, from the voxel's center, in units of its edges.
    [[nodiscard]] Vec3f inside(const VoxelStep& step, float t) const {
        const Vec3d at = ray_.origin + ray_.direction * static_cast<double>(t);
        return to_float(at - Vec3d{static_cast<double>(step.at.x) + 0.5,
                                   static_cast<double>(step.at.y) + 0.5,
                                   static_cast<double>(step.at.z) + 0.5});
    }
    /// Returns on which side of the surface the ray enters a voxel: of the last voxel's sheet if
    /// both sheets are parts of one surface, else of this voxel's sheet.
    [[nodiscard]] int
    side_of(const VoxelStep& step, const detail::PlacedSheet& sheet, float height) const {
        const int side = height < 0.0f ? -1 : 1;
        const LastSheet& last = passage_.last_sheet();
        if (last.side == 0) return side;
        const float gap = step.t_in - last.t;
        if (gap * speed_ > longest_) return side; // not neighbours
        const float turn = dot(last.normal, sheet.normal);
        const float sign = turn < 0.0f ? -1.0f : 1.0f;
        const float before = sign * (last.height + last.slope * gap);
        // The ray is as high above a common point of both slabs, but for their thickness and the
        // angle between them.
        const Vec3f bend = sheet.normal - last.normal * sign;
        const float error = last.thickness + sheet.thickness +
                            length(bend) * std::max(std::fabs(before), std::fabs(height));
        if (std::fabs(before - height) > error) return side;
        return turn < 0.0f ? -last.side : last.side;
    }
    /// Returns where the ray crosses to the other side: at the face where it enters if the sheets
    /// of both voxels do not meet there.
    [[nodiscard]] static float crossing(const VoxelStep& step, float in, float slope, int side) {
        if ((in < 0.0f ? -1 : 1) != side) return step.t_in;
        return std::clamp(step.t_in - in / slope, step.t_in, step.t_out);
    }

    const TraversalLevel& level_;
    Passage& passage_;
    const VoxelRay& ray_;
    Vec3f edges_;
    Vec3f direction_; ///< in voxels per unit of t
    float speed_;     ///< in the object's units per unit of t
    float longest_;   ///< edge
    float share_;
    std::int64_t start_;
};

} // namespace heddle
