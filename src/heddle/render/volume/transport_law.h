#pragma once

#include <heddle/base/random.h>
#include <heddle/render/volume/swept_depth.h>
#include <heddle/render/volume/transport.h>
#include <heddle/render/volume/walk.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

// How a ray passes the voxels of one level: one small law for each transport, chosen once a level.

namespace heddle {

namespace detail {

/// Voxels that a ray crosses along each axis per unit of its t.
[[nodiscard]] inline Vec3f rate_of(const VoxelRay& ray) {
    return to_float(
        Vec3d{std::fabs(ray.direction.x), std::fabs(ray.direction.y), std::fabs(ray.direction.z)});
}

} // namespace detail

/// What a ray carries through all voxels and levels that it passes: as a free flight what is left
/// of its threshold, else the depth of what it passed.
///
/// The threshold E is an exponential draw. A voxel stops the ray where the optical depth within the
/// voxel reaches E. Between voxels E is either used up by the depths, or kept in a run of voxels
/// and drawn anew at its end. In a run the light that passes is 1 - (the run's largest coverage);
/// its mean over the draws is the same law as the flight's.
class RayPassage {
public:
    /// @param flight  the ray is a free flight; else its transmittance is summed
    RayPassage(bool flight, StreamRandom& random)
        : flight_(flight), random_(random), threshold_(draw()) {}

    /// Starts on another level. Levels share no threshold: one that a run has kept is drawn anew.
    void enter_level() {
        if (in_run_ && flight_) threshold_ = draw();
        in_run_ = false;
    }
    /// Passes a voxel that knows nothing of the others: depths add up.
    /// @return  false: nothing behind matters
    bool pass_alone(const VoxelStep& step, float depth) {
        depth_ += depth;
        if (!goes_on(depth)) return stop(step, depth);
        threshold_ -= depth;
        return true;
    }
    /// Comes to the next voxel of a level whose voxels form runs: the run goes on, its threshold
    /// kept, or another one begins.
    /// @param chance  gives the probability that the run goes on; not called at a level's first
    ///                voxel
    template <typename Chance>
    void continue_run(const Chance& chance) {
        if (in_run_ && random_.uniform() < chance()) return;
        if (in_run_ && flight_) threshold_ = draw();
        in_run_ = true;
        largest_ = 0.0f;
    }
    /// Passes a voxel of a run: of a run only the densest voxel counts.
    /// @return  false: nothing behind matters
    bool pass_in_run(const VoxelStep& step, float depth) {
        depth_ += std::max(0.0f, depth - largest_);
        largest_ = std::max(largest_, depth);
        return goes_on(depth) || stop(step, depth);
    }

    [[nodiscard]] bool stopped() const { return stopped_; }
    [[nodiscard]] float t() const { return t_; } ///< where a flight stopped
    [[nodiscard]] float transmittance() const { return stopped_ ? 0.0f : std::exp(-depth_); }

private:
    static constexpr float kOpaque = 16.0f; ///< less than 1.2e-7 passes

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
    float threshold_;      ///< what is left of it where voxels use it up
    float depth_ = 0.0f;   ///< of what passes
    float largest_ = 0.0f; ///< of this run
    float t_ = 0.0f;
    bool stopped_ = false;
    bool in_run_ = false; ///< a voxel of a run came before in this level
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

/// Threshold: runs go on as far as the coverages of neighbours correlate; depths as with Product.
class CorrelatedVoxels {
public:
    CorrelatedVoxels(const TraversalLevel& level, const VoxelRay& ray, float /*bulk*/)
        : level_(level), rate_(detail::rate_of(ray)) {}

    [[nodiscard]] Vec3f depths(const VoxelStep& step) const {
        const Vec3f distance = rate_ * (step.t_out - step.t_in);
        return depths_of(level_.voxel(step.voxel)) * distance;
    }
    /// @param lower  the one of the face's two voxels with the lower index along `axis`
    [[nodiscard]] float keep_chance(int axis, std::int64_t lower) const {
        return static_cast<float>(level_.correlation(lower)[static_cast<std::size_t>(axis)]) *
               (1.0f / 255.0f);
    }

private:
    const TraversalLevel& level_;
    Vec3f rate_;
};

/// Footprint: the cells of each face that a ray's way sweeps stop it.
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
    /// What neighbours share beyond the cells. Of 0, 0.3, 0.5, 0.7 and 0.8 the value that errs
    /// least (docs/transport.md).
    static constexpr float kKeep = 0.5f;

    /// Where the ray is at t, in [0, 1]^3 of the voxel.
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

/// The law of voxels that form runs. At the face between two of them the run goes on with the
/// chance that Voxels tells: 0 would be the product of independent voxels; 1 a ray that, once
/// through a voxel, passes all that are no denser.
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
    /// 0 unless the voxel stands behind a face of the last one.
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

/// Calls walk(law) with the law that the asked transport is in a level, its data allowing.
/// @param ray   in the level's voxels; must outlive the call
/// @param bulk  Ray::bulk
template <typename Walk>
void with_law(Transport asked,
              const TraversalLevel& level,
              const VoxelRay& ray,
              float bulk,
              RayPassage& passage,
              const Walk& walk) {
    switch (resolve(asked, level)) {
    case Transport::Threshold: walk(RunLaw<CorrelatedVoxels>(level, ray, bulk, passage)); return;
    case Transport::Footprint: walk(RunLaw<FootprintVoxels>(level, ray, bulk, passage)); return;
    default: walk(ProductLaw(level, ray, passage)); return;
    }
}

} // namespace heddle
