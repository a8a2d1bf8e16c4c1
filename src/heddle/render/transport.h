#pragma once

#include <heddle/base/random.h>
#include <heddle/render/volume_level.h>
#include <heddle/render/walk.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace heddle {

/// How voxels of one ray are put together. docs/transport.md compares them.
enum class Transport : std::uint8_t {
    Automatic, ///< Footprint for fibers where the file has footprints, else Product
    Product,   ///< each voxel on its own: extinctions add up          [Fabre26, LopezMoreno17]
    Threshold, ///< a ray keeps what it drew from voxel to voxel as their faces correlate; Product
               ///< where the file has no correlation
    Footprint, ///< where a ray crosses the voxels' faces decides; Product without footprints
    Flakes     ///< a FlakeMedium in place of the Volume: one SGGX a voxel, interpolated [Heitz15]
};

/// Names on the command line, in the order of Transport.
[[nodiscard]] const std::vector<std::string>& transport_names();

/// The transport of that name; Automatic where it is empty.
/// @throws Error  InvalidArgument: no such name
[[nodiscard]] Transport transport_from(const std::string& name);

/// The transport that a level's data allow.
[[nodiscard]] inline Transport resolve(Transport asked, const VolumeLevel& level) {
    if (asked == Transport::Threshold) {
        return level.has_correlation() ? asked : Transport::Product;
    }
    const bool wants =
        asked == Transport::Footprint || (asked == Transport::Automatic && level.fibers_only());
    return wants && level.has_footprints() ? Transport::Footprint : Transport::Product;
}

/// One optical depth of three along the axes: the root of the sum of squares.
///
/// Exact on the axes, for fibers of one direction, and for fibers of all; crossed sheets would need
/// the sum instead. Nearer to traced geometry than the sum or their mean (docs/transport.md).
[[nodiscard]] inline float combine_depths(Vec3f depth) {
    return std::sqrt(dot(depth, depth));
}

/// A voxel's depths along the axes.
[[nodiscard]] inline Vec3f depths_of(const VolumeVoxel& voxel) {
    return Vec3f{static_cast<float>(voxel.depth[0]), static_cast<float>(voxel.depth[1]),
                 static_cast<float>(voxel.depth[2])} *
           kDepthUnit;
}

/// Depths along the axes of a ray that takes one way through the voxel: of the cells of each face that
/// its projection sweeps.
///
/// A ray along an axis meets one cell, set or not; an oblique one the swept share of set cells is its
/// coverage c. A covered column is blocked at one place in it: of a way through the part d of the
/// voxel along the axis c d is blocked. Depths that add up, 1 - (1 - c)^d, hold for fine dust; `many`
/// is their share. In the bulk of a yarn, fibers behind fibers, they add up and are kBulk times as
/// large, since fibers stand closer there than their coverage tells.
/// Where rounding set more cells than were covered they are thinned; where it set none the voxel is
/// even.
/// @param voxel       its own depths
/// @param footprints  VolumeLevel::footprints
/// @param many        many_of(level)
/// @param bulk        Ray::bulk
/// @param in, out     where the ray enters and leaves, in [0, 1]^3 of the voxel
[[nodiscard]] inline Vec3f depths_on_way(const VolumeVoxel& voxel,
                                         std::uint64_t footprints,
                                         float many,
                                         float bulk,
                                         Vec3f in,
                                         Vec3f out) {
    constexpr int kPoints = 4;
    constexpr float kFull = 1.0f - 1.0f / 128.0f; // a cell stands for its columns: never opaque
    constexpr float kFullBulk = 1.0f - 1e-4f;
    constexpr float kBulk = 1.5f;
    std::array<int, 3> hits{};
    const Vec3f way = out - in;
    const Vec3f step = way * (4.0f / kPoints);
    Vec3f at = in * 4.0f + step * 0.5f;
    for (int k = 0; k < kPoints; ++k, at = at + step) {
        const auto cell = [](float x) { return std::clamp(static_cast<int>(x), 0, 3); };
        const int x = cell(at.x), y = cell(at.y), z = cell(at.z);
        hits[0] += static_cast<int>(footprints >> (4 * z + y) & 1);
        hits[1] += static_cast<int>(footprints >> (16 + 4 * x + z) & 1);
        hits[2] += static_cast<int>(footprints >> (32 + 4 * y + x) & 1);
    }
    Vec3f depth{};
    for (int a = 0; a < 3; ++a) {
        const auto bits = static_cast<std::uint16_t>(footprints >> (16 * a));
        const int hit = hits[static_cast<std::size_t>(a)];
        const float part = std::fabs(way[a]);
        if ((bits != 0 && hit == 0) || part == 0.0f) continue; // most of the time
        const float covered =
            1.0f -
            std::exp(-kDepthUnit * static_cast<float>(voxel.depth[static_cast<std::size_t>(a)]));
        float swept = covered;
        if (bits != 0) {
            const float share = static_cast<float>(std::popcount(bits)) * (1.0f / 16.0f);
            swept = static_cast<float>(hit) * (1.0f / kPoints) * std::min(1.0f, covered / share);
        }
        depth[a] = -(1.0f - many) * std::log(1.0f - std::min(swept * part, kFull));
        if (many > 0.0f) depth[a] -= many * part * std::log(1.0f - std::min(swept, kFull));
        if (bulk > 0.0f) {
            const float behind = -kBulk * part * std::log(1.0f - std::min(swept, kFullBulk));
            depth[a] += bulk * (behind - depth[a]);
        }
    }
    return depth;
}

/// How far a level's columns hold many fibers behind each other, in [0, .3]: grows with the voxel's
/// edge in fiber radii. Chosen by transmittance against traced geometry (docs/transport.md).
[[nodiscard]] inline float many_of(const VolumeLevel& level) {
    constexpr float kFrom = 4.5f; // log2 of an edge of 23 radii
    constexpr float kRise = 0.15f;
    constexpr float kMost = 0.3f;
    return std::clamp((level.fibers_across() - kFrom) * kRise, 0.0f, kMost);
}

/// Walks a ray through voxels of one transport: as a free flight, or for its transmittance.
///
/// A ray carries a threshold E, an exponential draw. A voxel stops it where the optical depth within
/// the voxel reaches E. At a face E is kept with a probability and drawn anew otherwise: 0 is the
/// product of independent voxels; 1 a ray that, once through a voxel, passes all that are no denser.
/// The light that passes is the product over runs of kept thresholds of 1 - (the run's largest
/// coverage): its mean over the draws is the same law.
class TransportWalker {
public:
    /// @param flight  draw where the ray stops; else sum the depth of what passes
    /// @param bulk    Ray::bulk
    TransportWalker(Transport asked, bool flight, float bulk, StreamRandom& random)
        : asked_(asked), flight_(flight), bulk_(bulk), random_(random), left_(draw()) {}

    void enter(const VolumeLevel& level, const VoxelRay& ray) {
        kind_ = resolve(asked_, level);
        many_ = many_of(level);
        ray_ = ray;
        rate_ = to_float(Vec3d{std::fabs(ray.direction.x), std::fabs(ray.direction.y),
                               std::fabs(ray.direction.z)});
        if (any_ && flight_) left_ = draw(); // levels share no threshold
        any_ = false;
    }
    /// @return  false: nothing behind matters
    bool pass(const VolumeLevel& level, const VoxelStep& step) {
        const VolumeVoxel& voxel = level.voxel(step.voxel);
        const Vec3f distance = rate_ * (step.t_out - step.t_in);
        if (kind_ == Transport::Product) {
            const float depth = combine_depths(depths_of(voxel) * distance);
            depth_ += depth;
            if (flight_ ? depth < left_ : depth_ < kOpaque) {
                left_ -= depth;
                return true;
            }
            return stop(step, depth);
        }
        const bool keeps = any_ && random_.uniform() < keep_chance(level, step);
        if (!keeps) {
            if (any_ && flight_) left_ = draw();
            largest_ = 0.0f;
        }
        const Vec3f depths = kind_ == Transport::Footprint
                                 ? depths_on_way(voxel, level.footprints(step.voxel), many_, bulk_,
                                                 inside(step, step.t_in), inside(step, step.t_out))
                                 : depths_of(voxel) * distance;
        const float depth = combine_depths(depths);
        depth_ += std::max(0.0f, depth - largest_);
        largest_ = std::max(largest_, depth);
        last_ = step.at;
        last_voxel_ = step.voxel;
        any_ = true;
        if (flight_ ? depth < left_ : depth_ < kOpaque) return true;
        return stop(step, depth);
    }

    [[nodiscard]] bool stopped() const { return stopped_; }
    [[nodiscard]] float t() const { return t_; } ///< where a flight stopped
    [[nodiscard]] float transmittance() const { return stopped_ ? 0.0f : std::exp(-depth_); }

private:
    static constexpr float kOpaque = 16.0f; ///< less than 1.2e-7 passes
    /// Of a face between two voxels, with footprints: what neighbours share beyond the cells.
    static constexpr float kKeep = 0.5f;

    [[nodiscard]] float draw() { return -std::log(1.0f - random_.uniform()); }
    bool stop(const VoxelStep& step, float depth) {
        const float share = depth > 0.0f ? std::min(left_ / depth, 1.0f) : 0.0f;
        t_ = step.t_in + share * (step.t_out - step.t_in);
        stopped_ = true;
        return false;
    }
    [[nodiscard]] Vec3f inside(const VoxelStep& step, float t) const {
        const Vec3d at = ray_.origin + ray_.direction * static_cast<double>(t);
        return to_float(at - Vec3d{static_cast<double>(step.at.x), static_cast<double>(step.at.y),
                                   static_cast<double>(step.at.z)});
    }
    /// 0 unless the voxel stands behind a face of the last one.
    [[nodiscard]] float keep_chance(const VolumeLevel& level, const VoxelStep& step) const {
        const Vec3i d = step.at - last_;
        if (std::abs(d.x) + std::abs(d.y) + std::abs(d.z) != 1) return 0.0f;
        if (kind_ == Transport::Footprint) return kKeep;
        const int axis = d.x != 0 ? 0 : d.y != 0 ? 1 : 2;
        const std::int64_t lower = d[axis] > 0 ? last_voxel_ : step.voxel;
        return static_cast<float>(level.correlation(lower)[static_cast<std::size_t>(axis)]) *
               (1.0f / 255.0f);
    }

    Transport asked_;
    Transport kind_ = Transport::Product;
    bool flight_;
    float many_ = 0.0f;
    float bulk_;
    StreamRandom& random_;
    float left_;           ///< the threshold; with Product what is left of one for all voxels
    float depth_ = 0.0f;   ///< of what passes
    float largest_ = 0.0f; ///< of this run
    float t_ = 0.0f;
    bool stopped_ = false;
    bool any_ = false; ///< a voxel came before this one in the level
    Vec3i last_{};
    std::int64_t last_voxel_ = 0;
    VoxelRay ray_;
    Vec3f rate_{};
};

} // namespace heddle
