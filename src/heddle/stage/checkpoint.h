#pragma once

#include <heddle/render/picture.h>

#include <cstdint>
#include <string>

namespace heddle {

/// Saves a picture's sums, so that a cancelled render can continue and give the same bits.
/// @param hash    of all inputs on which the picture depends
/// @throws Error  CannotWrite
void write_checkpoint(const std::string& path, std::uint64_t hash, const Picture& picture);

/// Reads a checkpoint and checks that it is of this scene and size.
/// @param width, height  expected size, px
/// @throws Error  NotFound; BadFile: truncated, not a checkpoint, or of another scene or size
[[nodiscard]] Picture read_checkpoint(const std::string& path,
                                      std::uint64_t hash,
                                      std::int32_t width,
                                      std::int32_t height);

} // namespace heddle
