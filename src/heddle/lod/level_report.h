#pragma once

#include <heddle/base/progress.h>
#include <heddle/lod/rebuild_levels.h>
#include <heddle/lod/voxel_index.h>
#include <heddle/voxel/voxel_level.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace heddle {

/// What the coverage of coarse voxels is compared with.
enum class CoverageTruth : std::uint8_t {
    Union, ///< the exact union of all columns of the finest level
    File,  ///< the file's own levels, as it has no columns
    None   ///< nothing: neither exists, or the level is above kMaxUnionLevel
};

/// The errors of one method's level against the finest. Means and extremes are over the chosen
/// parents.
struct LevelErrors {
    int level = 0;
    std::int64_t voxels = 0; ///< voxels of the level
    std::int64_t lobes = 0;
    int parents = 0;     ///< number of voxels that were measured
    double sigma = 0.0;  ///< mean of DirectionError::sigma
    double cells = 0.0;  ///< mean of DirectionError::cells; the reference has noise of about 0.016
    double moment = 0.0; ///< median of DirectionError::moment
    double moment_worst = 0.0;
    /// mean share of directed area whose kind (tangents or normals) no lobe has; the errors above
    /// do not include it
    double lost = 0.0;
    std::optional<double> coverage; ///< mean of |c - truth| over parents and axes
    std::optional<double> coverage_worst;
};

/// All levels above 0 by one method.
struct MethodErrors {
    std::string name;
    std::vector<LevelErrors> levels;
};

struct LevelReportOptions {
    int parents = 2000; ///< largest number of voxels measured per level; the same for all methods
    std::uint64_t seed = 0;
};

/// Measures levels of detail by brute force against all voxels of the finest level below a voxel.
///
/// The reference for directions is all finest lobes below a parent. If the file has their sums,
/// they are weighted by them and S is fitted to them, unquantized; else they are weighted by share
/// times mean depth, as in rebuild_levels(). Lobes of tangents and of normals are measured
/// separately and averaged by weight. The lobes of a method are used as stored, in packed form.
///
/// Above the first level whose voxels are all measured, references are sums over the children. Each
/// finest lobe is pooled about 1.4 times in all, which takes 3 us of one core. Memory: 20 KiB per
/// parent.
class LevelReporter {
public:
    /// @param finest  level 0 of all methods; must outlive this
    /// @param file    the levels that coverage is compared with if there are no columns; must
    ///                outlive this; may be null
    LevelReporter(const VoxelLevel& finest,
                  const VoxelLevels* file,
                  const LevelReportOptions& options);
    ~LevelReporter();
    LevelReporter(const LevelReporter&) = delete;
    LevelReporter& operator=(const LevelReporter&) = delete;

    /// Copies the lobes of the chosen parents, so that the levels may be dropped afterwards. The
    /// first call chooses the parents.
    /// @param name    name of the method
    /// @param levels  at least two levels, built over `finest`
    /// @throws Error  InvalidArgument: the voxels are not those of the first call
    void take(const std::string& name, const VoxelLevels& levels);

    /// Returns the errors of all methods, in the order of take().
    /// @throws Error  Cancelled
    [[nodiscard]] std::vector<MethodErrors> measure(Progress& progress);

    /// Returns what the coverage of level 1 is compared with.
    [[nodiscard]] CoverageTruth coverage_truth() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Returns the numbers of blocks of a level, chosen by `seed`, that hold about `voxels` voxels in
/// total: a part to measure slow methods on. The numbers are ascending. If the level has fewer
/// voxels, all blocks are returned.
[[nodiscard]] std::vector<std::size_t>
choose_blocks(const VoxelLevel& source, std::int64_t voxels, std::uint64_t seed);

} // namespace heddle
