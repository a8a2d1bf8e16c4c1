#pragma once

namespace heddle::preview {

// What a ray takes of the voxels that it crosses. The preview walks on the host and the view in a
// shader (viewer/volume/voxel_walk_glsl.h); both take these.

/// Light that is less than this share of what there was is not followed.
inline constexpr float kOpaque = 0.004f;
/// PreviewVoxel::width below which a lobe of normals is a sheet, not foliage.
inline constexpr int kFlatWidth = 96;
/// How much of itself a sheet's voxel hides: more than what is exact in the mean, as the parts that
/// a ray meets do not add up to just 1. At 1 slanted surfaces look moth-eaten, at 1.5 they are
/// closed; edges come out half a voxel wider.
inline constexpr float kClosing = 1.5f;
/// Voxels that a ray may pass between two of one sheet's.
inline constexpr float kSheetGap = 0.5f;

} // namespace heddle::preview
