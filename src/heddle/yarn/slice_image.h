#pragma once

#include <heddle/geom/geometry.h>

#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

/// How a slice is made from a yarn.
struct SliceOptions {
    std::int32_t size = 256; ///< texels along each side, 1 to 4096
    std::uint64_t seed = 0;  ///< seed of the fibers' positions
};

/// A yarn's section as an image, and what the image leaves out.
struct SliceImage {
    YarnType yarn;                  ///< a yarn of model Slice, with the image in `slice`
    double outside = 0.0;           ///< share of the fibers' section outside the image's square
    std::vector<std::string> notes; ///< features of the yarn that one image along it cannot have
};

/// Returns the section of a yarn at its start as a slice. RGB is white, as the albedo is the
/// material's; alpha is the volume fraction of fiber in the texel. The image is a square with an
/// edge of 2 model radii. It twists as the plies do, or as the fibers of a single ply.
/// [LopezMoreno17, 3.2]
/// @throws Error  InvalidArgument: a size out of range; a yarn that is a slice or solid already
[[nodiscard]] SliceImage make_slice(const YarnType& yarn, const SliceOptions& options = {});

/// Replaces each procedural yarn of a geometry by a slice of 256 texels, which OpenGL can draw.
/// @param seed  seed of the fibers' positions
/// @return      notes on the features that the slices do not have
[[nodiscard]] std::vector<std::string> make_slices_of_yarns(Geometry& geometry, std::uint64_t seed);

/// Returns the fraction of light that reaches each texel from around, within the section's plane:
/// the mean over directions of exp(-integral of alpha 2 / (pi fiber_radius)), the projected area of
/// fibers per volume. For previews only: the transport in a volume is more exact. [LopezMoreno17,
/// 4.2]
/// @param yarn  a yarn of model Slice
/// @return      one channel of the image's size, 255 = all light
[[nodiscard]] Texture bake_occlusion(const YarnType& yarn);

/// Returns the image and its halved versions, down to one texel. The alpha of a texel is the mean
/// opacity of rays along the rows and columns of the four texels that it replaces. So a section
/// seen from the side keeps its opacity, while a mean of alpha would become more transparent
/// [LopezMoreno17, fig. 8]. Colours are weighted by alpha.
/// @param image  RGBA
[[nodiscard]] std::vector<Texture> shrink_slice(const Texture& image);

} // namespace heddle
