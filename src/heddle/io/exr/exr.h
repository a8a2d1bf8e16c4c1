#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace heddle {

/// One channel of a picture to write.
struct ExrChannel {
    std::string name; ///< "R", "depth", "tangent.X": optionally a layer and a dot first
    std::span<const float> values; ///< width x height, rows from the top
    bool half = true;              ///< stored with 16 bits: 11 of mantissa, at most 65504
};

/// Names and texts that the file's header stores: camera, samples, command.
using ExrAttributes = std::vector<std::pair<std::string, std::string>>;

/// Writes an OpenEXR file, completely or not at all (see OutputFile): scan lines, ZIP compression.
///
/// Half channels are rounded to the nearest value and clamped to +-65504, so that a bright light
/// does not become infinite; NaN stays NaN. Memory: the file's bytes, and 2 bytes per half pixel.
/// @param width, height  px, from 1 to 2^20, together at most 2^28
/// @param channels       1 to 1024; names differ and have 1 to 255 bytes
/// @param attributes     texts; names differ, have 1 to 255 bytes and are not the format's own
/// @throws Error  InvalidArgument: inconsistent sizes or names; NotFound or CannotWrite: the file
///                cannot be written; OutOfMemory
void write_exr(const std::string& path,
               std::int32_t width,
               std::int32_t height,
               std::span<const ExrChannel> channels,
               const ExrAttributes& attributes = {});

/// An image of float values without limits.
struct FloatImage {
    std::int32_t width = 0;    ///< px
    std::int32_t height = 0;   ///< px
    std::int32_t channels = 3; ///< per pixel, interleaved
    std::vector<float> values; ///< width x height x channels, rows from the top
};

/// Reads R, G and B of an OpenEXR file: scan lines or tiles (the largest level), any compression.
///
/// A file with Y but no R, G, B returns Y three times. The picture is the file's data window.
/// Values are as stored: the caller checks for NaN and infinity. Memory: the file's bytes and the
/// result.
/// @throws Error  NotFound; BadFile: truncated, damaged, deep or multi-part, without R, G, B or Y,
///                larger than 2^28 px or than its bytes can hold; OutOfMemory
[[nodiscard]] FloatImage read_exr_rgb(const std::string& path);

} // namespace heddle
