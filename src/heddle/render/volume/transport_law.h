#pragma once

#include <heddle/base/random.h>
#include <heddle/render/volume/cell_law.h>
#include <heddle/render/volume/sheet_law.h>
#include <heddle/render/volume/transport.h>
#include <heddle/render/volume/walk.h>

#include <algorithm>
#include <cmath>

// How a ray passes the voxels of one level: one small law per transport, chosen once per level.

namespace heddle {

namespace detail {

/// Voxels that a ray crosses along each axis per unit of its t.
[[nodiscard]] inline Vec3f rate_of(const VoxelRay& ray) {
    return to_float(
        Vec3d{std::fabs(ray.direction.x), std::fabs(ray.direction.y), std::fabs(ray.direction.z)});
}

} // namespace detail

/// The state of a ray across voxels and levels: the remaining threshold of a free flight, or the
/// optical depth so far if the transmittance is computed.
///
/// The threshold E is an exponential draw. A flight stops where the optical depth reaches E.
class RayPassage {
public:
    /// @param flight  the ray is a free flight; else its transmittance is computed
    RayPassage(bool flight, StreamRandom& random)
        : flight_(flight), random_(random), threshold_(draw()) {}

    /// Passes a voxel that is independent of the others: optical depths add up.
    /// @return  false: the traversal ends here
    bool pass_alone(const VoxelStep& step, float depth) {
        return pass_alone(step.t_in, step.t_out, depth);
    }
    /// Passes a part of a voxel.
    bool pass_alone(float t_in, float t_out, float depth) {
        depth_ += depth;
        if (!goes_on(depth)) return stop(t_in, t_out, depth);
        threshold_ -= depth;
        return true;
    }
    /// Crosses a sheet, which stops the ray with probability 1 - exp(-depth).
    /// @param side  of the sheet from which the ray comes: 1 above, -1 below
    /// @return      false: the traversal ends here
    bool pass_sheet(float t, float depth, int side) {
        depth_ += depth;
        if (goes_on(depth)) {
            threshold_ -= depth;
            return true;
        }
        t_ = t;
        side_ = side;
        stopped_ = true;
        return false;
    }
    [[nodiscard]] LastSheet& last_sheet() { return last_sheet_; }

    [[nodiscard]] bool stopped() const { return stopped_; }
    [[nodiscard]] float t() const { return t_; } ///< where a flight stopped
    /// Returns the side of the sheet that stopped the ray; 0 if no sheet did.
    [[nodiscard]] int side() const { return side_; }
    [[nodiscard]] float transmittance() const { return stopped_ ? 0.0f : std::exp(-depth_); }

private:
    static constexpr float kOpaque = 16.0f; ///< a transmittance below 1.2e-7

    [[nodiscard]] float draw() { return -std::log(1.0f - random_.uniform()); }
    [[nodiscard]] bool goes_on(float depth) const {
        return flight_ ? depth < threshold_ : depth_ < kOpaque;
    }
    bool stop(float t_in, float t_out, float depth) {
        const float share = depth > 0.0f ? std::min(threshold_ / depth, 1.0f) : 0.0f;
        t_ = t_in + share * (t_out - t_in);
        stopped_ = true;
        return false;
    }

    bool flight_;
    StreamRandom& random_;
    float threshold_;    ///< remaining part
    float depth_ = 0.0f; ///< optical depth so far
    float t_ = 0.0f;
    bool stopped_ = false;
    int side_ = 0;
    LastSheet last_sheet_;
};

/// Product: each voxel stops a ray on its own.                        [Fabre26, LopezMoreno17]
class ProductLaw {
public:
    ProductLaw(const TraversalLevel& level, const VoxelRay& ray, RayPassage& passage)
        : level_(level), passage_(passage), rate_(detail::rate_of(ray)) {}

    /// @return  false: nothing behind matters
    bool pass(const VoxelStep& step) {
        const Vec3f distance = rate_ * (step.t_out - step.t_in);
        return passage_.pass_alone(step, combine_depths(level_.depths(step.voxel) * distance));
    }

private:
    const TraversalLevel& level_;
    RayPassage& passage_;
    Vec3f rate_;
};

/// What a law needs of a ray beside its path.
struct LawArguments {
    const FiberStart& from_fiber; ///< Ray::from_fiber
    float sheet;                  ///< Ray::sheet
    std::int64_t start;           ///< voxel of the level on whose sheet the ray starts; -1: none
    float scale;                  ///< of the volume instance
};

/// Calls walk(law) with the law of the transport that resolve() gives for the level.
/// @param ray   in the level's voxels; must outlive the call
template <typename Walk>
void with_law(Transport asked,
              const TraversalLevel& level,
              const VoxelRay& ray,
              const LawArguments& from,
              RayPassage& passage,
              const Walk& walk) {
    switch (resolve(asked, level)) {
    case Transport::Cells:
        walk(CellLaw<RayPassage>(level, ray, from.from_fiber, from.scale, passage));
        return;
    case Transport::Sheet:
        walk(SheetLaw<RayPassage>(level, ray, from.sheet, from.start, passage));
        return;
    default: walk(ProductLaw(level, ray, passage)); return;
    }
}

} // namespace heddle
