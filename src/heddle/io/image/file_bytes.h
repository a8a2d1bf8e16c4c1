#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace heddle {

/// All bytes of a regular file.
/// @throws NotFound where there is none; BadFile for a folder, a device or an unreadable file;
///         OutOfMemory where it is larger than the memory that is free
[[nodiscard]] std::vector<std::byte> read_bytes(const std::filesystem::path& path);

/// Writes `parts` one after the other beside `path` and renames the result onto it, so that `path`
/// holds the old bytes or all of the new ones, never a part.
/// @throws BadFile where the folder cannot be written or the disk is full; the old file stays
void replace_file(const std::filesystem::path& path,
                  std::span<const std::span<const std::byte>> parts);

} // namespace heddle
