#pragma once

#include <cstdint>

namespace heddle {

enum class CoverageMode : std::uint8_t {
    Columns, ///< a column counts when its centre ray meets the geometry inside the voxel
    Mask     ///< the paper's: sampled subvoxels projected along the axis   [Fabre26, 3.5]
};

enum class FitMode : std::uint8_t {
    Moments, ///< the SGGX whose second moment is the pooled one
    Last     ///< the direction of one sample, as earlier voxelizers keep
};

/// How primitives are gathered into a block's sums.
struct GatherOptions {
    CoverageMode coverage = CoverageMode::Columns;
    FitMode fit = FitMode::Moments;
    std::int64_t samples = 0; ///< per span, with CoverageMode::Mask; 0: two a subvoxel
};

} // namespace heddle
