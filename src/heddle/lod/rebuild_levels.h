#pragma once

#include <heddle/lod/build_levels.h>

namespace heddle {

/// Builds the levels over a finished level 0 again.
///
/// With masks (VoxelFields::masks) they have the bits of the first build. Without, moments are
/// taken back from the stored S, and the result says so (VoxelLevelInfo::approximate); coverage and
/// what neighbours share are those of the old levels where there are any, else transparencies
/// multiply along an axis and average across it, which is all that imports without columns allow.
/// @param old    level 0 and what levels there are; each block of level 0 lies in a cell of 32^3
///               voxels
/// @param exact  throws where masks are missing
/// @throws Error  InvalidArgument: `exact` without masks; Cancelled
[[nodiscard]] VoxelLevels
rebuild_levels(VoxelLevels old, const LodOptions& options, bool exact, Progress& progress);

} // namespace heddle
