#pragma once

#include <heddle/geom/geometry.h>

#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

/// How a slice is made from a yarn.
struct SliceOptions {
    std::int32_t size = 256; ///< texels along each side, 1 to 4096
    std::uint64_t seed = 0;  ///< of the fibers' places
};

/// A yarn's section, and what the image leaves out.
struct SliceImage {
    YarnType yarn;                  ///< of the model Slice, with the image in `slice`
    double outside = 0.0;           ///< share of the fibers' section outside the image's square
    std::vector<std::string> notes; ///< what the yarn had and one image swept along it has not
};

/// The section of a yarn at its start as a slice: RGB the yarn's white (its albedo stays the
/// material's), alpha the volume fraction of fiber in the texel; the image fills the square of
/// 2 model radii. It twists as the plies do, or the fibers of a single ply.  [LopezMoreno17, 3.2]
/// @throws Error  InvalidArgument: a size out of range; a yarn that is a slice or solid already
[[nodiscard]] SliceImage make_slice(const YarnType& yarn, const SliceOptions& options = {});

/// Makes each procedural yarn of a geometry a slice of 256 texels: what OpenGL draws.
/// @param seed  of the fibers' places
/// @return      notes on what the slices do not have
[[nodiscard]] std::vector<std::string> make_slices_of_yarns(Geometry& geometry, std::uint64_t seed);

/// How much of the light from around reaches each texel within the section's plane: the mean over
/// directions of exp(-integral of alpha 2 / (pi fiber_radius)), the projected area of fibers per
/// volume. For previews; the volume's own light transport knows it better.   [LopezMoreno17, 4.2]
/// @param yarn  of the model Slice
/// @return  one channel, of the image's size, 255 = all
[[nodiscard]] Texture bake_occlusion(const YarnType& yarn);

/// Half the size again and again, down to one texel; the first is the image itself. A texel's alpha
/// becomes the mean opacity of rays through its four along rows and along columns, so that a
/// section seen from the side stays as opaque as it was, where the mean of alpha grows clear
/// [LopezMoreno17, fig. 8]. Colours are weighted by alpha.
/// @param image  RGBA
[[nodiscard]] std::vector<Texture> shrink_slice(const Texture& image);

} // namespace heddle
