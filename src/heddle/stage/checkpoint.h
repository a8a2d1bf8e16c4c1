#pragma once

#include <heddle/render/picture.h>

#include <cstdint>
#include <string>

namespace heddle {

/// Keeps a picture's sums, so that a render that was stopped goes on with the same bits.
/// @param hash  of all that the picture depends on
/// @throws Error  CannotWrite
void write_checkpoint(const std::string& path, std::uint64_t hash, const Picture& picture);

/// @param width, height  px, that the picture has now
/// @throws Error  NotFound; BadFile: cut, not a checkpoint, or of another scene or size
[[nodiscard]] Picture read_checkpoint(const std::string& path,
                                      std::uint64_t hash,
                                      std::int32_t width,
                                      std::int32_t height);

} // namespace heddle
