#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

/// What one grid of a .vdb holds.
struct GridSummary {
    std::string name;
    int level = 0;    ///< as the name says; 0 where it says none
    std::string type; ///< "float", "vec3s", "int32", "int64"
    std::int64_t active_voxels = 0;
    std::int64_t bytes = 0; ///< in the file, description included
    std::uint64_t hash = 0; ///< of its name and its active voxels' indices and values
};

/// The grids of a .vdb in the file's order, each read back whole and one at a time.
/// @throws Error  as read_contents; BadFile: damaged; Unsupported: a value type not named above
[[nodiscard]] std::vector<GridSummary> summarize_vdb(const std::string& path);

/// 16 hex digits over all voxels of the grids: name, index and value of every active voxel. Neither
/// the order of grids or voxels nor compression, UUID or metadata show.
/// @param grids  of summarize_vdb
[[nodiscard]] std::string content_hash(const std::vector<GridSummary>& grids);

/// content_hash(summarize_vdb(path)).
[[nodiscard]] std::string content_hash(const std::string& path);

} // namespace heddle
