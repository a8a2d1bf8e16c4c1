#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace heddle {

/// Checks the Huffman tables of a JPEG file, which its decoder does not: each table has at most 256
/// codes and no more of a length than fit, and a scan only uses tables that are defined before it.
/// Bytes that are not a JPEG, and all other errors, are left to the decoder.
/// @param name  for messages
/// @throws BadFile with the byte offset
void check_jpeg_tables(std::span<const std::byte> bytes, const std::string& name);

} // namespace heddle
