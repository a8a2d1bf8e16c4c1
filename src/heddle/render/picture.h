#pragma once

#include <heddle/base/vec.h>
#include <heddle/render/path.h>
#include <heddle/sggx/sggx.h>

#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

/// What the samples of a pixel sum to.
struct PixelSums {
    double red = 0.0, green = 0.0, blue = 0.0;
    double square = 0.0; ///< of luminance
    double transmittance = 0.0;
    double depth = 0.0; ///< of the samples that met something, as the rest
    double level = 0.0;
    Vec3f axis{}, albedo{};
    SymmetricMatrix axes{}; ///< second moment: tangents have no sign
    std::uint32_t samples = 0;
    std::uint32_t hits = 0;
    std::uint32_t material = 0; ///< of the first sample that met something

    void add(const PathSample& sample);
};

/// A picture in the making: sums of samples, which passes add to.
struct Picture {
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::vector<PixelSums> pixels; ///< row by row from the top

    Picture() = default;
    Picture(std::int32_t w, std::int32_t h)
        : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

    /// Root of the mean over pixels of the luminance's variance of the mean, clamped at 1 so that a
    /// few bright ones do not decide; 0 before every pixel has two samples.
    [[nodiscard]] double noise() const;
};

/// One channel of a finished picture.
struct PictureChannel {
    std::string name; ///< "R", "depth", "axis.X"
    std::vector<float> values;
};

/// R G B A and, where asked, depth, transmittance, axis.X Y Z, albedo.R G B, level, material,
/// samples, variance (of the mean luminance).
///
/// axis is the direction along which the first hits' axes gather: normals on the side that they
/// face, tangents, which have no side, with their largest component positive.
[[nodiscard]] std::vector<PictureChannel> channels_of(const Picture& picture, bool all);

/// R, G, B, A in 8 bits: exposed, and by the sRGB curve.
/// @param exposure  stops: radiance is multiplied by 2^exposure
[[nodiscard]] std::vector<std::uint8_t> to_srgb8(const Picture& picture, double exposure);

} // namespace heddle
