#pragma once

namespace heddle {

/// Fixed-point scale of weights and moments: one unit^2 of directed area is 2^20; 64-bit sums hold
/// 8.8e12 units^2.
constexpr float kWeightScale = 1048576.0f;

/// Directed area that a fiber leaves in a voxel that its side alone reaches into, units^2 a column:
/// little beside any centreline's, enough to name a direction where nothing else does.
constexpr float kGrazeWeight = 1.0f / 256.0f;

} // namespace heddle
