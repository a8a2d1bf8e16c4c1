#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace heddle {

/// Checks the Huffman tables of a JPEG file, which its decoder takes as they are: that each table has
/// at most 256 codes and no more of a length than fit, and that a scan names only tables that stand
/// before it. Bytes that are no JPEG, and all that is wrong otherwise, are left to the decoder.
/// @param name  the place in messages
/// @throws BadFile with the byte
void check_jpeg_tables(std::span<const std::byte> bytes, const std::string& name);

} // namespace heddle
