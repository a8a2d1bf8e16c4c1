#pragma once

#include <heddle/geom/texture.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace heddle {

/// The image in a PNG or JPEG file, with the channels that the file has; 16 bits become 8.
/// @return `srgb` unset and wrapping by repetition: what the texels mean, the caller knows
/// @throws NotFound, BadFile
[[nodiscard]] Texture read_image(const std::filesystem::path& path);

/// The image in the bytes of a PNG or JPEG file; see read_image.
/// @param name  becomes Texture::name and the place in messages
/// @throws BadFile
[[nodiscard]] Texture decode_image(std::span<const std::byte> bytes, const std::string& name);

/// The bytes of a PNG file.
/// @param width, height  px, from 1 to 2^24
/// @param channels       1 grey, 2 grey and alpha, 3 RGB, 4 RGBA
/// @param texels         width x height x channels values, rows from the top
/// @throws InvalidArgument where the sizes do not agree or pass 2^31 bytes
[[nodiscard]] std::vector<std::uint8_t> encode_png(std::int32_t width,
                                                   std::int32_t height,
                                                   std::int32_t channels,
                                                   std::span<const std::uint8_t> texels);

/// Writes a PNG file, whole or not at all (see OutputFile); arguments as for encode_png.
/// @throws InvalidArgument; NotFound or CannotWrite where it cannot be written
void write_png(const std::filesystem::path& path,
               std::int32_t width,
               std::int32_t height,
               std::int32_t channels,
               std::span<const std::uint8_t> texels);

} // namespace heddle
