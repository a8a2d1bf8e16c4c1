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

/// How an input is inspected. Nothing is required.
struct InspectOptions {
    GeometryOptions geometry{};
    std::optional<Vec3d> voxel_size{};    ///< scene units per axis, for the plan
    std::optional<std::int64_t> voxels{}; ///< along the longest axis; if neither is given: 512
};

/// Totals of all sets of curves.
struct CurveSummary {
    CurveStats sum{};
    std::vector<Basis> bases{}; ///< without repetition, in the order of the sets
    Bounds bounds{};            ///< of the centrelines, widened by the largest radius
};

/// Totals of all meshes.
struct MeshSummary {
    std::int64_t meshes = 0;
    std::int64_t triangles = 0;
    std::int64_t vertices = 0;
    bool normals = true, tangents = true, uvs = true; ///< true if every mesh has them
    Bounds bounds{};
};

/// One yarn type.
struct YarnSummary {
    std::string name{};
    std::int64_t fibers = 0; ///< in a yarn
};

/// One texture.
struct TextureSummary {
    std::string name{};
    std::int32_t width = 0, height = 0, channels = 0;
    std::int64_t bytes = 0;
};

/// The contents of a geometry, and what voxelizing it would take.
struct GeometryInfo {
    std::optional<CurveSummary> curves{}; ///< none: there are no curves
    std::optional<MeshSummary> meshes{};  ///< none: there are no meshes
    Bounds bounds{};                      ///< of curves and meshes
    std::vector<YarnSummary> yarns{};
    std::vector<Material> materials{};
    std::vector<TextureSummary> textures{};
    std::optional<VoxelizePlan> plan{}; ///< none: see `why_not`
    std::int64_t predicted_file_bytes = 0;
    std::string why_not{}; ///< the reason why there is no plan
    std::vector<std::string> notes{};
};

/// The contents of a .vdb that Heddle wrote.
struct VolumeInfo {
    std::vector<VoxelLevelInfo> levels{}; ///< finest first
    std::vector<GridSummary> grids{};
    std::string content_hash{};
};

/// The contents of any supported file.
struct FileInfo {
    std::string file{};
    std::int64_t file_bytes = 0;
    std::variant<GeometryInfo, VolumeInfo, VolLayout> content;
};

/// Summarizes a geometry and plans its voxelization.
/// @throws OptionError  both `voxels` and `voxel_size` are given
/// @throws Error        as load_geometry; Cancelled
[[nodiscard]] GeometryInfo
inspect_geometry(GeometryInput input, const InspectOptions& options, Progress& progress);

/// Inspects a file of curves or meshes, a .vol, or a .vdb that Heddle wrote. Every voxel of a .vdb
/// is read and checked.
/// @throws OptionError  an option that only curves and meshes have is given for a .vol or a .vdb
/// @throws Error        as the reader of the format, and inspect_geometry
[[nodiscard]] FileInfo
inspect_file(const std::string& path, const InspectOptions& options, Progress& progress);

} // namespace heddle::job
