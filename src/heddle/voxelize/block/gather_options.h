#pragma once

#include <cstdint>

namespace heddle {

/// How coverage is computed.
enum class CoverageMode : std::uint8_t {
    Columns, ///< a column is covered if its centre line hits the geometry inside the voxel
    Mask     ///< as in the paper: sampled subvoxels, projected along the axis   [Fabre26, 3.5]
};

/// How a lobe's SGGX is computed.
enum class FitMode : std::uint8_t {
    Moments, ///< the SGGX with the pooled second moment
    Last     ///< the direction of the last sample only, as in earlier voxelizers
};

/// How primitives are gathered into a block's sums.
struct GatherOptions {
    CoverageMode coverage = CoverageMode::Columns;
    FitMode fit = FitMode::Moments;
    std::int64_t samples = 0; ///< per span, with CoverageMode::Mask; 0: two per subvoxel
};

} // namespace heddle
