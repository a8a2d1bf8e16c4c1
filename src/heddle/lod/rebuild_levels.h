#pragma once

#include <heddle/lod/build_levels.h>

namespace heddle {

/// Builds the levels over a finished level 0 again.
///
/// With masks (VoxelFields::masks) they are the levels of the first build, bit for bit. Without,
/// moments are computed from the stored S, and VoxelLevelInfo::approximate is set in the result.
/// Then coverage, footprints and correlation are copied from the old levels if there are any; else
/// transparencies are multiplied along an axis and averaged across it.
/// @param old    level 0 and the levels above it, if any; each block of level 0 lies in an aligned
///               cube of 32^3 voxels
/// @param exact  true: throws if masks are missing
/// @throws Error  InvalidArgument: `exact` without masks; Cancelled
[[nodiscard]] VoxelLevels
rebuild_levels(VoxelLevels old, const LodOptions& options, bool exact, Progress& progress);

} // namespace heddle
