#pragma once

#include <heddle/geom/texture.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace heddle {

/// Reads a PNG or JPEG file, with the channels that the file has; 16 bits become 8.
/// @return with `srgb` unset and repeating: the caller knows what the texels mean
/// @throws NotFound, BadFile
[[nodiscard]] Texture read_image(const std::filesystem::path& path);

/// Decodes the bytes of a PNG or JPEG file; see read_image.
/// @param name  for Texture::name and messages
/// @throws BadFile
[[nodiscard]] Texture decode_image(std::span<const std::byte> bytes, const std::string& name);

/// Encodes a PNG file and returns its bytes.
/// @param width, height  px, from 1 to 2^24
/// @param channels       1 grey, 2 grey and alpha, 3 RGB, 4 RGBA
/// @param texels         width x height x channels values, rows from the top
/// @throws InvalidArgument: the sizes are inconsistent or exceed 2^31 bytes
[[nodiscard]] std::vector<std::uint8_t> encode_png(std::int32_t width,
                                                   std::int32_t height,
                                                   std::int32_t channels,
                                                   std::span<const std::uint8_t> texels);

/// Writes a PNG file, completely or not at all (see OutputFile); arguments as for encode_png.
/// @throws InvalidArgument; NotFound or CannotWrite: the file cannot be written
void write_png(const std::filesystem::path& path,
               std::int32_t width,
               std::int32_t height,
               std::int32_t channels,
               std::span<const std::uint8_t> texels);

} // namespace heddle
