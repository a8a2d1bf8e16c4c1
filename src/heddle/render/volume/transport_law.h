#pragma once

#include <heddle/base/random.h>
#include <heddle/render/volume/sheet_law.h>
#include <heddle/render/volume/swept_depth.h>
#include <heddle/render/volume/transport.h>
#include <heddle/render/volume/walk.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

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
/// The threshold E is an exponential draw. A voxel stops the ray where the optical depth within the
/// voxel reaches E. For independent voxels, each optical depth is subtracted from E. In a run of
/// voxels, E stays the same and is drawn anew at the end of the run, so that the transmittance of a
/// run is 1 - (its largest coverage). The mean transmittance over the draws follows the same law as
/// free flights.
class RayPassage {
public:
    /// @param flight  the ray is a free flight; else its transmittance is computed
    RayPassage(bool flight, StreamRandom& random)
        : flight_(flight), random_(random), threshold_(draw()) {}

    /// Enters another level. A run ends there, so its threshold is drawn anew.
    void enter_level() {
        if (in_run_ && flight_) threshold_ = draw();
        in_run_ = false;
    }
    /// Passes a voxel that is independent of the others: optical depths add up.
    /// @return  false: the traversal ends here
    bool pass_alone(const VoxelStep& step, float depth) {
        depth_ += depth;
        if (!goes_on(depth)) return stop(step, depth);
        threshold_ -= depth;
        return true;
    }
    /// Prepares the next voxel of a level whose voxels form runs: the run continues with its
    /// threshold, or a new run begins.
    /// @param chance  returns the probability that the run continues; not called at a level's first
    ///                voxel
    template <typename Chance>
    void continue_run(const Chance& chance) {
        if (in_run_ && random_.uniform() < chance()) return;
        if (in_run_ && flight_) threshold_ = draw();
        in_run_ = true;
        largest_ = 0.0f;
    }
    /// Passes a voxel of a run, of which only the densest voxel counts.
    /// @return  false: the traversal ends here
    bool pass_in_run(const VoxelStep& step, float depth) {
        depth_ += std::max(0.0f, depth - largest_);
        largest_ = std::max(largest_, depth);
        return goes_on(depth) || stop(step, depth);
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
    bool stop(const VoxelStep& step, float depth) {
        const float share = depth > 0.0f ? std::min(threshold_ / depth, 1.0f) : 0.0f;
        t_ = step.t_in + share * (step.t_out - step.t_in);
        stopped_ = true;
        return false;
    }

    bool flight_;
    StreamRandom& random_;
    float threshold_;      ///< remaining part, if voxels are independent
    float depth_ = 0.0f;   ///< optical depth so far
    float largest_ = 0.0f; ///< largest optical depth of this run
    float t_ = 0.0f;
    bool stopped_ = false;
    int side_ = 0;
    LastSheet last_sheet_;
    bool in_run_ = false; ///< the last voxel in this level is of a run
};

/// Product: each voxel stops a ray on its own.                        [Fabre26, LopezMoreno17]
class ProductLaw {
public:
    ProductLaw(const TraversalLevel& level, const VoxelRay& ray, RayPassage& passage)
        : level_(level), passage_(passage), rate_(detail::rate_of(ray)) {}

    /// @return  false: nothing behind matters
    bool pass(const VoxelStep& step) {
        const Vec3f distance = rate_ * (step.t_out - step.t_in);
        return passage_.pass_alone(step,
                                   combine_depths(depths_of(level_.voxel(step.voxel)) * distance));
    }

private:
    const TraversalLevel& level_;
    RayPassage& passage_;
    Vec3f rate_;
};

/// Threshold: runs continue as far as the coverages of neighbours correlate; depths as in Product.
class CorrelatedVoxels {
public:
    CorrelatedVoxels(const TraversalLevel& level, const VoxelRay& ray, float /*bulk*/)
        : level_(level), rate_(detail::rate_of(ray)) {}

    [[nodiscard]] Vec3f depths(const VoxelStep& step) const {
        const Vec3f distance = rate_ * (step.t_out - step.t_in);
        return depths_of(level_.voxel(step.voxel)) * distance;
    }
    /// Returns the probability that a run continues through a face.
    /// @param lower  of the face's two voxels, the one with the lower index along `axis`
    [[nodiscard]] float keep_chance(int axis, std::int64_t lower) const {
        return static_cast<float>(level_.correlation(lower)[static_cast<std::size_t>(axis)]) *
               (1.0f / 255.0f);
    }

private:
    const TraversalLevel& level_;
    Vec3f rate_;
};

/// Footprint: a ray is stopped by the set cells of each face that its path crosses.
class FootprintVoxels {
public:
    /// @param bulk  Ray::bulk
    FootprintVoxels(const TraversalLevel& level, const VoxelRay& ray, float bulk)
        : level_(level), ray_(ray), many_(fiber_crowding(level)), bulk_(bulk) {}

    [[nodiscard]] Vec3f depths(const VoxelStep& step) const {
        return depths_along_path(level_.voxel(step.voxel), level_.footprints(step.voxel), many_,
                                 bulk_, inside(step, step.t_in), inside(step, step.t_out));
    }
    [[nodiscard]] float keep_chance(int /*axis*/, std::int64_t /*lower*/) const { return kKeep; }

private:
    /// Probability that a run continues. Of 0, 0.3, 0.5, 0.7 and 0.8, this value has the smallest
    /// error (docs/transport.md).
    static constexpr float kKeep = 0.5f;

    /// Returns the point of the ray at t, in [0, 1]^3 of the voxel.
    [[nodiscard]] Vec3f inside(const VoxelStep& step, float t) const {
        const Vec3d at = ray_.origin + ray_.direction * static_cast<double>(t);
        return to_float(at - Vec3d{static_cast<double>(step.at.x), static_cast<double>(step.at.y),
                                   static_cast<double>(step.at.z)});
    }

    const TraversalLevel& level_;
    const VoxelRay& ray_;
    float many_;
    float bulk_;
};

/// The law of voxels that form runs. At the face between two voxels the run continues with the
/// probability that Voxels returns. With 0, voxels would be independent; with 1, a ray that has
/// passed a voxel would pass all others that are no denser.
/// @tparam Voxels  CorrelatedVoxels or FootprintVoxels
template <typename Voxels>
class RunLaw {
public:
    RunLaw(const TraversalLevel& level, const VoxelRay& ray, float bulk, RayPassage& passage)
        : voxels_(level, ray, bulk), passage_(passage) {}

    /// @return  false: nothing behind matters
    bool pass(const VoxelStep& step) {
        passage_.continue_run([&] { return keep_chance(step); });
        last_ = step.at;
        last_voxel_ = step.voxel;
        return passage_.pass_in_run(step, combine_depths(voxels_.depths(step)));
    }

private:
    /// Returns 0 unless the voxel shares a face with the last one.
    [[nodiscard]] float keep_chance(const VoxelStep& step) const {
        const Vec3i d = step.at - last_;
        if (std::abs(d.x) + std::abs(d.y) + std::abs(d.z) != 1) return 0.0f;
        const int axis = d.x != 0 ? 0 : d.y != 0 ? 1 : 2;
        return voxels_.keep_chance(axis, d[axis] > 0 ? last_voxel_ : step.voxel);
    }

    Voxels voxels_;
    RayPassage& passage_;
    Vec3i last_{};
    std::int64_t last_voxel_ = 0;
};

/// What a law needs of a ray beside its path.
struct LawArguments {
    float bulk;         ///< Ray::bulk
    float sheet;        ///< Ray::sheet
    std::int64_t start; ///< voxel of the level on whose sheet the ray starts; -1: none
};

/// Calls walk(law) with the law of the transport that resolve() gives for the level.
/// @param ray  in the level's voxels; must outlive the call
template <typename Walk>
void with_law(Transport asked,
              const TraversalLevel& level,
              const VoxelRay& ray,
              const LawArguments& from,
              RayPassage& passage,
              const Walk& walk) {
    switch (resolve(asked, level)) {
    case Transport::Threshold:
        walk(RunLaw<CorrelatedVoxels>(level, ray, from.bulk, passage));
        return;
    case Transport::Footprint:
        walk(RunLaw<FootprintVoxels>(level, ray, from.bulk, passage));
        return;
    case Transport::Sheet:
        walk(SheetLaw<RayPassage>(level, ray, from.sheet, from.start, passage));
        return;
    default: walk(ProductLaw(level, ray, passage)); return;
    }
}

} // namespace heddle
