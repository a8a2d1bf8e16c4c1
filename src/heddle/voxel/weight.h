#pragma once

namespace heddle {

/// Fixed-point scale of weights and moments: one unit^2 of directed area is 2^20. 64-bit sums hold
/// 8.8e12 units^2.
constexpr float kWeightScale = 1048576.0f;

/// Directed area, in units^2 per column, that a fiber adds to a voxel that its surface reaches but
/// its centreline does not: little beside that of any centreline, enough to give a direction if
/// nothing else does.
constexpr float kGrazeWeight = 1.0f / 256.0f;

} // namespace heddle
