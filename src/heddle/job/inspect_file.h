#pragma once

#include <heddle/base/progress.h>
#include <heddle/io/curve/curve_info.h>
#include <heddle/io/vdb/content_hash.h>
#include <heddle/io/vol/vol_layout.h>
#include <heddle/job/geometry_input.h>
#include <heddle/voxel/voxel_level.h>
#include <heddle/voxelize/plan.h>

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace heddle::job {

/// How an input is looked at. Nothing is required.
struct InspectOptions {
    GeometryOptions geometry{};
    std::optional<Vec3d> voxel_size{};    ///< scene units per axis, of the plan
    std::optional<std::int64_t> voxels{}; ///< along the longest axis; with neither: 512
};

/// All sets of curves together.
struct CurveSummary {
    CurveStats sum{};
    std::vector<Basis> bases{}; ///< each once, in the order of the sets
    Bounds bounds{};            ///< of the tubes: the largest radius about the centrelines
};

/// All meshes together.
struct MeshSummary {
    std::int64_t meshes = 0;
    std::int64_t triangles = 0;
    std::int64_t vertices = 0;
    bool normals = true, tangents = true, uvs = true; ///< every mesh has them
    Bounds bounds{};
};

struct YarnSummary {
    std::string name{};
    std::int64_t fibers = 0; ///< in a yarn
};

struct TextureSummary {
    std::string name{};
    std::int32_t width = 0, height = 0, channels = 0;
    std::int64_t bytes = 0;
};

/// What curves and meshes hold, and what voxelizing them would take.
struct GeometryInfo {
    std::optional<CurveSummary> curves{}; ///< none: there are none
    std::optional<MeshSummary> meshes{};
    Bounds bounds{}; ///< of both
    std::vector<YarnSummary> yarns{};
    std::vector<Material> materials{};
    std::vector<TextureSummary> textures{};
    std::optional<VoxelizePlan> plan{}; ///< none: it cannot be done as asked
    std::int64_t predicted_file_bytes = 0;
    std::string why_not{}; ///< there is no plan
    std::vector<std::string> notes{};
};

/// What a .vdb of Heddle's holds.
struct VolumeInfo {
    std::vector<VoxelLevelInfo> levels{}; ///< finest first
    std::vector<GridSummary> grids{};
    std::string content_hash{};
};

struct FileInfo {
    std::string file{};
    std::int64_t file_bytes = 0;
    std::variant<GeometryInfo, VolumeInfo, VolLayout> content;
};

/// @throws OptionError  `voxels` and `voxel_size`
/// @throws Error        as load_geometry; Cancelled
[[nodiscard]] GeometryInfo
inspect_geometry(GeometryInput input, const InspectOptions& options, Progress& progress);

/// Curves, meshes, a .vol, or a .vdb of Heddle's, of which every voxel is read and checked.
/// @throws Error  as the readers; as inspect_geometry
[[nodiscard]] FileInfo
inspect_file(const std::string& path, const InspectOptions& options, Progress& progress);

} // namespace heddle::job
