#pragma once

#include "directions.h"

#include <heddle/sggx/mixture_error.h>
#include <heddle/voxel/voxel_level.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace heddle::bench {

inline constexpr std::size_t kKinds = 2; ///< number of values of Kind

/// A pooled second moment and its weight.
struct PooledMoment {
    std::array<double, 6> moment{};
    double weight = 0.0;
};

/// Some voxels of a level, and all directions of the geometry in them, by brute force.
class Parents {
public:
    /// @param level  only its voxels are used, not their lobes
    /// @param most   number to choose, by seeded hash; all if the level has no more
    Parents(const VoxelLevel& level, std::size_t most);

    [[nodiscard]] std::size_t size() const { return voxels_.size(); }
    [[nodiscard]] bool has_all() const { return voxels_.size() == there_; }
    [[nodiscard]] std::size_t voxels_in_level() const { return there_; }
    [[nodiscard]] Vec3i voxel(std::size_t i) const { return voxels_[i]; }

    static constexpr std::uint32_t kNotThere = 0xffffffffu; ///< the level does not have this voxel
    static constexpr std::uint32_t kNotChosen = 0xfffffffeu;
    /// Index of a voxel of this level among the chosen ones, or one of the constants above.
    [[nodiscard]] std::uint32_t find(Vec3i at) const;

    /// Adds directions of level 0, on all threads; those of one parent in their order.
    void add(std::span<const Directed> directions);
    /// Adds the sums of the parents of the level below, if they are all of its voxels.
    void add_below(const Parents& below);
    /// Pools the unquantized sums of level 0.
    /// @param finest  with masks
    void pool(const VoxelLevel& finest);

    [[nodiscard]] const DirectionTruth& truth(std::size_t i, Kind kind) const {
        return truths_[i * kKinds + static_cast<std::size_t>(kind)];
    }
    [[nodiscard]] const PooledMoment& pooled(std::size_t i, Kind kind) const {
        return pooled_[i * kKinds + static_cast<std::size_t>(kind)];
    }
    /// Fraction of the geometry's directed area that is in no voxel of this level.
    [[nodiscard]] double lost() const { return total_ > 0.0 ? lost_ / total_ : 0.0; }

private:
    int level_ = 0;
    std::size_t there_ = 0;
    Vec3i lo_, size_;
    std::vector<std::uint32_t> number_; ///< of each voxel of the box
    std::vector<Vec3i> voxels_;
    std::vector<DirectionTruth> truths_;
    std::vector<PooledMoment> pooled_;
    std::vector<std::uint32_t> found_; ///< scratch of add()
    double lost_ = 0.0;
    double total_ = 0.0;
};

/// The decoded lobes that a level stores for a voxel.
struct Mixture {
    std::array<std::vector<MixtureLobe>, kKinds> lobes;
};

/// The mixtures of the chosen voxels.
[[nodiscard]] std::vector<Mixture> decode(const VoxelLevel& level, const Parents& parents);

inline constexpr double kMomentGoal = 0.01; ///< for every voxel

/// The errors of a level, over its chosen voxels.
struct LevelErrors {
    std::size_t count = 0;                        ///< voxels with directions of this kind
    double moment_max = 0.0, moment_median = 0.0; ///< against the geometry
    double pooled_max = 0.0, pooled_median = 0.0; ///< against the sums of level 0
    double sigma = 0.0;                           ///< mean
    double cells = 0.0;                           ///< mean
    std::size_t over = 0;    ///< voxels whose moment errs by more than kMomentGoal
    double over_share = 0.0; ///< their share of the measured directed area
};

[[nodiscard]] LevelErrors
measure(const std::vector<Mixture>& mixtures, const Parents& parents, Kind kind);

} // namespace heddle::bench
