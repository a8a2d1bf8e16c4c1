#pragma once

namespace heddle::preview {

// Constants of the traversal that the preview runs on the host and the viewer in a shader
// (viewer/volume/voxel_walk_glsl.h).

/// A ray ends when its transmittance is below this.
inline constexpr float kOpaque = 0.004f;
/// A lobe of normals with a PreviewVoxel::width below this is a flat surface, not foliage.
inline constexpr int kFlatWidth = 96;
/// Factor of the opacity of a flat surface's voxels. With 1, the mean is exact, but the opacities
/// along a ray do not add up to exactly 1 and slanted surfaces have holes; with 1.5 they are
/// closed, and edges are half a voxel wider.
inline constexpr float kClosing = 1.5f;
/// Largest distance along a ray, in voxels, between two voxels of one surface.
inline constexpr float kSheetGap = 0.5f;

} // namespace heddle::preview
