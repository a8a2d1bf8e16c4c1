#pragma once

#include <heddle/base/progress.h>
#include <heddle/voxel/voxel_level.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace heddle {

/// What the colours of a preview show.
enum class PreviewColor : std::uint8_t {
    Albedo,   ///< material colour, shaded by a light at the eye: Kajiya-Kay or Lambert
    Tangent,  ///< x^2, y^2, z^2 of the heaviest lobe's direction as red, green, blue; the brushing
              ///< of an anisotropic surface
    Width,    ///< of the heaviest lobe: needles blue, round ones red
    Material, ///< one colour per material
    Block     ///< one colour per block of 32^3 voxels
};

/// How a preview is drawn.
struct PreviewOptions {
    std::int32_t width = 1024;  ///< pixels, 1 to 16384
    std::int32_t height = 1024; ///< pixels, 1 to 16384
    PreviewColor color = PreviewColor::Albedo;
    std::optional<Vec3d> from; ///< direction from the object to the eye, any length but 0; none:
                               ///< three quarters from the front, from above
    /// 0, 1 or 2; -1: z if the object is flat and wide along x and y, else y
    std::int32_t up_axis = -1;
    double field_of_view = 0.0; ///< radians across the picture's height, below pi; 0: orthographic
    std::int32_t rays = 1;      ///< per pixel and axis, 1 to 8
    bool transparent = false;   ///< stores alpha; else the picture is opaque, over white
};

/// 8 bits per channel, sRGB, with straight alpha: 255 is opaque.
struct PreviewImage {
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::vector<std::uint8_t> rgba; ///< width x height x 4, rows from the top
};

/// Draws a picture of the voxels, fitted to the frame, on the CPU and without a window. It is meant
/// for inspection, not for measurements.
///
/// Each ray steps through occupied leaves and their voxels, front to back. A voxel that the ray
/// crosses over the length s lets exp(-k s) through, k^2 = sum (d_a k_a)^2 with k_a = -ln(1 - c_a)
/// / h_a: exact along the axes, for isotropic voxels, and for surfaces perpendicular to an axis.
/// The opacity of a flat surface's voxels does not depend on where the ray enters them, and adds up
/// between neighbours on the ray; the transmittances of all other voxels are multiplied. Memory: 12
/// bytes per voxel and 170 bytes per leaf.
/// @throws Error  InvalidArgument: a size, direction or angle is out of range; Cancelled
[[nodiscard]] PreviewImage
render_preview(const VoxelLevel& source, const PreviewOptions& options, Progress& progress);

} // namespace heddle
