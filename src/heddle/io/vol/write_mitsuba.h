#pragma once

#include <heddle/base/progress.h>
#include <heddle/flake/flake_field.h>
#include <heddle/geom/bounds.h>

#include <cstdint>
#include <string>

namespace heddle {

/// The dense box that a FlakeField is written as.
struct MitsubaBox {
    Vec3i low;           ///< voxel index of its first sample
    Vec3i size;          ///< samples
    Bounds bounds;       ///< scene units: samples stand at the centres of its cells
    Bounds content;      ///< of the voxels that are there: what the camera looks at
    std::int64_t voxels; ///< samples in all
    std::int64_t bytes;  ///< of all files: Mitsuba holds as many
};

/// The box of all voxels and one more on each side, so that what is interpolated ends inside it.
/// @param pad  grows it by this factor on each axis with emptiness; >= 1
/// @throws Error  InvalidArgument: no voxels
[[nodiscard]] MitsubaBox plan_mitsuba(const FlakeField& field, double pad);

/// Writes DIR/sigma_t.vol (1 channel, per scene unit), DIR/S.vol (xx yy zz xy xz yz), DIR/albedo.vol
/// where the albedo varies, and DIR/scene.xml, which Mitsuba 3 renders: VOL version 3, floats.
///
/// Memory: twelve layers of the box. The folder is made.
/// @throws Error  OutOfMemory: the box needs more than is free, for Mitsuba will hold it;
///                CannotWrite; Cancelled
void write_mitsuba(const FlakeField& field,
                   const MitsubaBox& box,
                   const std::string& folder,
                   Progress& progress);

} // namespace heddle
