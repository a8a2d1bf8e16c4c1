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
    Union, ///< of all columns of the finest level, to the bit
    File,  ///< no columns are kept: what the file's own levels hold
    None   ///< neither is there
};

/// How far one method's level is from the finest. Means and extremes are over the chosen parents.
struct LevelErrors {
    int level = 0;
    std::int64_t voxels = 0; ///< of the level
    std::int64_t lobes = 0;
    int parents = 0;     ///< voxels that were measured
    double sigma = 0.0;  ///< mean of DirectionError::sigma
    double cells = 0.0;  ///< mean of DirectionError::cells; the truth's own noise is about .016
    double moment = 0.0; ///< median of DirectionError::moment
    double moment_worst = 0.0;
    /// mean share of directed area whose kind, tangents or normals, no lobe has: it is not in the
    /// errors above
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
    int parents = 2000; ///< voxels that are measured on a level, at most; the same for all methods
    std::uint64_t seed = 0;
};

/// Measures levels of detail by brute force against all that the finest level holds below a voxel.
///
/// Truth of directions: the finest lobes below a parent, weighed by their sums where the file has
/// such (then S is fitted to these, unquantized), else by share times mean depth as
/// rebuild_levels() has it. Lobes of tangents and of normals are measured apart, then averaged by
/// weight. A method's lobes are taken as stored, packed.
///
/// From the first level of which all voxels are measured on, truths are sums of the children's: the
/// finest lobes are pooled about 1.4 times in all, 3 us each and core. Memory: 20 KiB a parent.
class LevelReporter {
public:
    /// @param finest  level 0 of all that is taken; must outlive this
    /// @param file    the levels that coverage is compared with where there are no columns; may be
    ///                null, else must outlive this
    LevelReporter(const VoxelLevel& finest,
                  const VoxelLevels* file,
                  const LevelReportOptions& options);
    ~LevelReporter();
    LevelReporter(const LevelReporter&) = delete;
    LevelReporter& operator=(const LevelReporter&) = delete;

    /// Takes what the chosen parents hold; the levels may be dropped then. The first call chooses
    /// them.
    /// @param levels  of the same finest level, at least two
    /// @throws Error  InvalidArgument: other voxels than the first call's
    void take(const std::string& name, const VoxelLevels& levels);

    /// @throws Error  Cancelled
    [[nodiscard]] std::vector<MethodErrors> measure(Progress& progress);

    [[nodiscard]] CoverageTruth coverage_truth() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Blocks of a source, chosen by seed, that hold about so many voxels: a part to measure slow
/// methods on. Ascending numbers; all blocks where there are fewer voxels.
[[nodiscard]] std::vector<std::size_t>
choose_blocks(const VoxelLevel& source, std::int64_t voxels, std::uint64_t seed);

} // namespace heddle
