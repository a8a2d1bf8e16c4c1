#include <heddle/cli/info_parts.h>

#include <heddle/base/error.h>
#include <heddle/base/format_number.h>
#include <heddle/cli/rows/report_parts.h>

namespace heddle::cli {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(Vec3d v) {
    return {v.x, v.y, v.z};
}

/// Adds one row per level, with its contents and its bytes.
void report_levels(Report& report,
                   const std::vector<VoxelLevelInfo>& levels,
                   const std::vector<GridSummary>& grids) {
    Json list = Json::array();
    std::vector<std::vector<std::string>> rows;
    for (const VoxelLevelInfo& info : levels) {
        std::int64_t bytes = 0;
        for (const GridSummary& grid : grids) bytes += grid.level == info.level ? grid.bytes : 0;
        const auto per_voxel = [&](std::int64_t n) {
            return info.voxel_count > 0
                       ? static_cast<double>(n) / static_cast<double>(info.voxel_count)
                       : 0.0;
        };
        const double lobes = per_voxel(info.lobe_count), size = per_voxel(bytes);
        list.push_back({{"level", info.level},
                        {"voxel_size", to_json(info.lattice.voxel_size)},
                        {"voxels", info.voxel_count},
                        {"lobes", info.lobe_count},
                        {"lobes_per_voxel", lobes},
                        {"bytes", bytes},
                        {"bytes_per_voxel", size}});
        rows.push_back({str("level ", info.level),
                        format_count(static_cast<double>(info.voxel_count)), format_fixed(lobes, 3),
                        format_bytes(static_cast<double>(bytes)), format_fixed(size, 1)});
    }
    report.table("levels", std::move(list),
                 {"levels", "voxels", "lobes per voxel", "size", "bytes per voxel"}, rows);
}

/// Returns the grids of level 0, such as "a (int64), b (float)". Grids of sums are only counted.
std::string show_grids(const std::vector<GridSummary>& grids) {
    std::string names;
    int sums = 0;
    for (const GridSummary& g : grids) {
        if (g.level > 0) continue;
        if (g.name.starts_with("sums_")) {
            ++sums;
        } else {
            names += str(names.empty() ? "" : ", ", g.name, " (", g.type, ")");
        }
    }
    return sums == 0 ? names : str(names, ", ", sums, " grids of sums (int64)");
}

} // namespace

void report_material_names(Report& report, const std::vector<Material>& materials) {
    Json list = Json::array();
    std::string names;
    for (const Material& material : materials) {
        const char* kind = material.kind == MaterialKind::Fiber ? "fiber" : "surface";
        list.push_back({{"name", material.name},
                        {"kind", kind},
                        {"albedo", {material.albedo.x, material.albedo.y, material.albedo.z}},
                        {"roughness", material.roughness},
                        {"metalness", material.metalness},
                        {"anisotropy", material.anisotropy}});
        names += str(names.empty() ? "" : ", ", material.name.empty() ? "(unnamed)" : material.name,
                     " (", kind, ")");
    }
    report.add("materials", "materials", std::move(list), names.empty() ? "none" : names);
}

void report_volume(Report& report, const job::VolumeInfo& volume) {
    const std::vector<VoxelLevelInfo>& levels = volume.levels;
    const std::vector<GridSummary>& grids = volume.grids;
    const VoxelLevelInfo& info = levels[0];
    const Vec3d size = info.lattice.voxel_size;
    report.text("name", info.name);
    report.add("voxel_size", "voxel size", to_json(size), show(size) + " scene units");
    report.count("subvoxels", info.lattice.subvoxels, "per voxel axis");
    report.count("voxels", info.voxel_count);
    report.count("lobes", info.lobe_count);
    report.add("most_lobes", "maximum lobes", info.max_lobes, str(info.max_lobes, " per voxel"));
    report_material_names(report, info.materials);
    for (const YarnType& yarn : info.yarns) report.text("yarn", yarn.name);
    report.text("command", info.command);
    Json list = Json::array();
    std::int64_t bytes = 0;
    for (const GridSummary& g : grids) {
        list.push_back(
            {{"name", g.name}, {"type", g.type}, {"voxels", g.active_voxels}, {"bytes", g.bytes}});
        bytes += g.bytes;
    }
    report.add("grids", "grids", std::move(list), show_grids(grids));
    report_levels(report, levels, grids);
    if (levels.size() > 1) {
        report.text("lod", info.lod);
        report.add("approximate", "levels built from", info.approximate,
                   info.approximate ? "stored lobes (approximate)" : "columns and sums");
    }
    if (info.voxel_count > 0) {
        const double all = static_cast<double>(bytes) / static_cast<double>(info.voxel_count);
        report.add("bytes_per_voxel", "all levels", all,
                   format_fixed(all, 1) + " bytes per voxel of level 0");
    }
    report.text("content hash", volume.content_hash);
}

} // namespace heddle::cli
