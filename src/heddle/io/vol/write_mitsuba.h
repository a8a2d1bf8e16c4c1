#pragma once

#include <heddle/base/progress.h>
#include <heddle/flake/flake_field.h>
#include <heddle/geom/bounds.h>

#include <cstdint>
#include <string>

namespace heddle {

/// The dense box of samples that stores a FlakeField.
struct MitsubaBox {
    Vec3i low;           ///< voxel index of the first sample
    Vec3i size;          ///< samples
    Bounds bounds;       ///< scene units: samples are at the centres of its cells
    Bounds content;      ///< of the voxels that exist: the camera looks at it
    std::int64_t voxels; ///< total number of samples
    std::int64_t bytes;  ///< of all files; Mitsuba needs this much memory
};

/// The box of all voxels and one more on each side, so that interpolated values end inside it.
/// @param pad  factor by which empty space enlarges it on each axis; >= 1
/// @throws Error  InvalidArgument: no voxels
[[nodiscard]] MitsubaBox plan_mitsuba(const FlakeField& field, double pad);

/// Writes DIR/sigma_t.vol (1 channel, per scene unit), DIR/S.vol (xx yy zz xy xz yz),
/// DIR/albedo.vol if the albedo varies, and DIR/scene.xml for Mitsuba 3. VOL version 3, floats.
///
/// Memory: twelve layers of the box. The folder is created.
/// @throws Error  OutOfMemory: the box needs more memory than is free, as Mitsuba will hold it;
///                CannotWrite; Cancelled
void write_mitsuba(const FlakeField& field,
                   const MitsubaBox& box,
                   const std::string& folder,
                   Progress& progress);

} // namespace heddle
