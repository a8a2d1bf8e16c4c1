#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace heddle {

/// An entry of the file's table of contents: one grid.
struct GridEntry {
    std::string name;
    std::string type;         ///< "Tree_float_5_4_3", with "_HalfFloat" if it is stored so
    std::int64_t begin = 0;   ///< first byte of its description
    std::int64_t buffers = 0; ///< first byte of its values
    std::int64_t end = 0;     ///< one after its last byte
};

/// The contents of a .vdb without the voxels of its grids.
struct VdbContents {
    std::map<std::string, std::string> metadata;  ///< of the file: strings, int32 in decimal
    std::map<std::string, std::int64_t> value_at; ///< byte of a string's length, before it
    std::vector<GridEntry> grids;                 ///< in the file's order
    std::int64_t bytes = 0;                       ///< of the whole file

    /// The grid with this name; null if there is none.
    [[nodiscard]] const GridEntry* find(const std::string& name) const;
};

/// Reads a .vdb's table of contents and checks that every grid is inside the file and that the file
/// ends with the last one.
/// @throws Error  NotFound: no such file; BadFile: not readable, not a VDB, truncated, extra bytes;
///                Unsupported: older than OpenVDB 2, or written without a table of contents
[[nodiscard]] VdbContents read_contents(const std::string& path);

} // namespace heddle
