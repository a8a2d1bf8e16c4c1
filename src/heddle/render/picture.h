#pragma once

#include <heddle/base/vec.h>
#include <heddle/render/path.h>
#include <heddle/sggx/sggx.h>

#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

/// The sums of a pixel's samples.
struct PixelSums {
    double red = 0.0, green = 0.0, blue = 0.0;
    double square = 0.0; ///< of luminance
    double transmittance = 0.0;
    double depth = 0.0; ///< this and the rest: of samples that hit something
    double level = 0.0;
    Vec3f axis{}, albedo{};
    SymmetricMatrix axes{}; ///< second moment, as tangents have no sign
    std::uint32_t samples = 0;
    std::uint32_t hits = 0;
    std::uint32_t material = 0; ///< of the first sample that hit something

    void add(const PathSample& sample);
};

/// An unfinished picture: sums of samples, to which each pass adds.
struct Picture {
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::vector<PixelSums> pixels; ///< row by row from the top

    Picture() = default;
    Picture(std::int32_t w, std::int32_t h)
        : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

    /// Returns the root mean square, over pixels, of the standard error of the mean luminance.
    /// Variances are clamped at 1 so that a few bright pixels do not dominate. 0 until every pixel
    /// has two samples.
    [[nodiscard]] double noise() const;
};

/// One channel of a finished picture.
struct PictureChannel {
    std::string name; ///< "R", "depth", "axis.X"
    std::vector<float> values;
};

/// Returns R G B A and, if `all`, depth, transmittance, axis.X Y Z, albedo.R G B, level, material,
/// samples, variance (of the mean luminance).
///
/// axis is the principal direction of the first hits' axes: of normals, on the side that they
/// face; of tangents, which have no sign, with its largest component positive.
[[nodiscard]] std::vector<PictureChannel> channels_of(const Picture& picture, bool all);

/// Returns R, G, B, A in 8 bits, after exposure, in sRGB.
/// @param exposure  stops: radiance is multiplied by 2^exposure
[[nodiscard]] std::vector<std::uint8_t> to_srgb8(const Picture& picture, double exposure);

} // namespace heddle
