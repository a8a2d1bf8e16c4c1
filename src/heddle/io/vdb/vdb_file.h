#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

/// A grid as the file's own table of contents names it.
struct GridEntry {
    std::string name;
    std::string type;         ///< "Tree_float_5_4_3", with "_HalfFloat" where it is stored so
    std::int64_t begin = 0;   ///< first byte of its description
    std::int64_t buffers = 0; ///< first byte of its values
    std::int64_t end = 0;     ///< one past its last byte
};

/// Reads a .vdb's table of contents and checks that every grid lies inside the file and that the
/// file ends with the last one: what OpenVDB trusts, and a truncated file breaks.
/// @throws Error  NotFound: no such file or not readable; BadFile: not a VDB, truncated, extra bytes;
///                Unsupported: older than OpenVDB 3, or written without a table of contents
[[nodiscard]] std::vector<GridEntry> read_grid_entries(const std::string& path);

} // namespace heddle
