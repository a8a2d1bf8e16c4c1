#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

/// A summary of one grid of a .vdb.
struct GridSummary {
    std::string name;
    int level = 0;    ///< as its name says; 0 if it says none
    std::string type; ///< "float", "vec3s", "int32", "int64"
    std::int64_t active_voxels = 0;
    std::int64_t bytes = 0; ///< in the file, including the description
    std::uint64_t hash = 0; ///< of its name and the indices and values of its active voxels
};

/// The grids of a .vdb in the file's order; each is read completely, one at a time.
/// @throws Error  as read_contents; BadFile: damaged; Unsupported: a value type not listed above
[[nodiscard]] std::vector<GridSummary> summarize_vdb(const std::string& path);

/// A hash of 16 hex digits over the name, index and value of every active voxel of the grids. It is
/// independent of the order of grids or voxels, of compression, UUID and metadata.
/// @param grids  as summarize_vdb returns them
[[nodiscard]] std::string content_hash(const std::vector<GridSummary>& grids);

/// content_hash(summarize_vdb(path)).
[[nodiscard]] std::string content_hash(const std::string& path);

} // namespace heddle
