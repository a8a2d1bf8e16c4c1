#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace heddle {

/// One channel of a picture to be written.
struct ExrChannel {
    std::string name;              ///< "R", "depth", "tangent.X": a layer and a dot before the name
    std::span<const float> values; ///< width x height, rows from the top
    bool half = true;              ///< stored with 16 bits: 11 of mantissa, at most 65504
};

/// Names and texts that the file's header keeps beside the picture: camera, samples, command.
using ExrAttributes = std::vector<std::pair<std::string, std::string>>;

/// Writes an OpenEXR file, whole or not at all (see OutputFile): scan lines, ZIP compression.
///
/// Half channels are rounded to nearest and clamped to +-65504, so that a bright light does not
/// become infinite; NaN stays NaN. Memory: the file's bytes, and 2 bytes a pixel and half channel.
/// @param width, height  px, from 1 to 2^20, together at most 2^28
/// @param channels       1 to 1024; names differ, have 1 to 255 bytes
/// @param attributes     texts; names differ, have 1 to 255 bytes, are none of the format's own
/// @throws Error  InvalidArgument: sizes or names that do not agree; NotFound or CannotWrite where
///                it cannot be written; OutOfMemory
void write_exr(const std::string& path,
               std::int32_t width,
               std::int32_t height,
               std::span<const ExrChannel> channels,
               const ExrAttributes& attributes = {});

/// A picture of numbers without bounds.
struct FloatImage {
    std::int32_t width = 0;    ///< px
    std::int32_t height = 0;   ///< px
    std::int32_t channels = 3; ///< of a pixel, next to each other
    std::vector<float> values; ///< width x height x channels, rows from the top
};

/// R, G and B of an OpenEXR file: scan lines or tiles (the largest level), any compression.
///
/// A file that holds Y and no R, G, B gives Y three times. The picture is the file's data window.
/// Values are as stored: NaN and infinities are for the caller to judge. Memory: the file's bytes
/// and the result.
/// @throws Error  NotFound; BadFile: cut short, damaged, deep or of several parts, without R, G, B
///                or Y, larger than 2^28 px or than its bytes can hold; OutOfMemory
[[nodiscard]] FloatImage read_exr_rgb(const std::string& path);

} // namespace heddle
