#include <heddle/base/error.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/load.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/cli/terminal/text.h>
#include <heddle/cli/voxel_options.h>
#include <heddle/cli/voxelize_vol.h>
#include <heddle/io/curve/curve_info.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/vdb/content_hash.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vol/vol_layout.h>

#include <algorithm>
#include <filesystem>

namespace heddle::cli {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(Vec3d v) {
    return {v.x, v.y, v.z};
}
std::string show(Vec3d v) {
    return str(v.x, ", ", v.y, ", ", v.z);
}

void report_bounds(Report& report, const Bounds& bounds) {
    if (bounds.empty()) return;
    report.add("bounds", "bounds", {to_json(bounds.lo), to_json(bounds.hi)},
               str(show(bounds.lo), "  to  ", show(bounds.hi)));
    const Vec3d size = bounds.size();
    report.add("size", "size", to_json(size),
               str(size.x, " x ", size.y, " x ", size.z, " scene units"));
}

std::string basis_name(Basis basis) {
    switch (basis) {
    case Basis::Linear: return "polyline";
    case Basis::CatmullRom: return "Catmull-Rom";
    case Basis::CubicBSpline: return "cubic B-spline";
    }
    return {};
}

/// Rows of all curve sets together.
/// @return  the bounds of the tubes: centrelines and the largest radius about them
Bounds report_curves(Report& report, const std::vector<CurveSet>& sets) {
    CurveStats sum;
    std::string bases;
    Bounds bounds;
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const CurveStats one = measure(sets[i]);
        sum.curves += one.curves;
        sum.points += one.points;
        sum.spans += one.spans;
        sum.closed += one.closed;
        sum.length += one.length;
        sum.radius_min = i == 0 ? one.radius_min : std::min(sum.radius_min, one.radius_min);
        sum.radius_max = std::max(sum.radius_max, one.radius_max);
        if (!one.bounds.empty()) {
            bounds.grow(one.bounds.lo, double{one.radius_max});
            bounds.grow(one.bounds.hi, double{one.radius_max});
        }
        const std::string basis = basis_name(sets[i].basis);
        if (bases.find(basis) == std::string::npos) bases += (bases.empty() ? "" : ", ") + basis;
    }
    report.count("curves", static_cast<std::int64_t>(sum.curves));
    report.text("basis", bases);
    report.count("closed curves", static_cast<std::int64_t>(sum.closed));
    report.count("points", static_cast<std::int64_t>(sum.points));
    report.count("spans", static_cast<std::int64_t>(sum.spans));
    report.number("length", sum.length, "scene units");
    report.add("radius", "radius", {sum.radius_min, sum.radius_max},
               sum.radius_min == sum.radius_max
                   ? str(sum.radius_min, " scene units")
                   : str(sum.radius_min, " to ", sum.radius_max, " scene units"));
    return bounds;
}

Bounds report_meshes(Report& report, const std::vector<Mesh>& meshes) {
    Bounds bounds;
    std::size_t triangles = 0;
    std::size_t vertices = 0;
    bool normals = true;
    bool tangents = true;
    bool uvs = true;
    for (const Mesh& mesh : meshes) {
        triangles += mesh.triangles.size();
        vertices += mesh.positions.size();
        normals = normals && !mesh.normals.empty();
        tangents = tangents && !mesh.tangents.empty();
        uvs = uvs && !mesh.uvs.empty();
        for (const Vec3f p : mesh.positions) bounds.grow(to_double(p));
    }
    report.count("meshes", static_cast<std::int64_t>(meshes.size()));
    report.count("triangles", static_cast<std::int64_t>(triangles));
    report.count("vertices", static_cast<std::int64_t>(vertices));
    std::string with = normals ? "normals" : "";
    if (tangents) with += with.empty() ? "tangents" : ", tangents";
    if (uvs) with += with.empty() ? "uv" : ", uv";
    with = with.empty() ? "positions" : with;
    report.add("all_have", "vertex data", with, with + (meshes.size() > 1 ? " in every mesh" : ""));
    return bounds;
}

void report_materials(Report& report, const std::vector<Material>& materials) {
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

void report_textures(Report& report, const std::vector<Texture>& textures) {
    Json list = Json::array();
    std::size_t bytes = 0;
    for (const Texture& texture : textures) {
        list.push_back({{"name", texture.name},
                        {"width", texture.width},
                        {"height", texture.height},
                        {"channels", texture.channels}});
        bytes += texture.texels.size();
    }
    report.add("textures", "textures", std::move(list),
               textures.empty()
                   ? "none"
                   : str(textures.size(), ", ", show_bytes(static_cast<double>(bytes))));
}

/// What voxelizing would take, or in one row why it cannot be done as asked.
void report_plan(Report& report,
                 const Geometry& geometry,
                 const VoxelizeOptions& options,
                 const ProgressBar& bar) {
    VoxelizePlan plan;
    try {
        plan = plan_voxelize(geometry, options, bar);
    } catch (const Error& e) {
        if (e.code() == ErrorCode::Cancelled) throw;
        return report.add("voxelizing", "cannot voxelize", e.what(), e.what());
    }
    const Vec3d size = plan.lattice.voxel_size;
    const Vec3i n = plan.voxel_hi - plan.voxel_lo;
    report.add("voxel_size", "voxel size", to_json(size),
               str(show(size), " scene units: ", n.x, " x ", n.y, " x ", n.z, " voxels"));
    report_work(report, plan);
}

void report_input(Report& report,
                  const std::string& path,
                  const Arguments& arguments,
                  const ProgressBar& bar) {
    Geometry geometry = load_geometry(path, arguments);
    apply_model(geometry, arguments);
    Bounds bounds;
    if (!geometry.curves.empty()) bounds.grow(report_curves(report, geometry.curves));
    if (!geometry.meshes.empty()) bounds.grow(report_meshes(report, geometry.meshes));
    report_bounds(report, bounds);
    for (const YarnType& yarn : geometry.yarns) {
        report.text("yarn", yarn.name);
        report.count("fibers", yarn.fiber_count(), "per yarn");
    }
    report_materials(report, geometry.materials);
    report_textures(report, geometry.textures);
    report_plan(report, geometry, resolution_from(arguments), bar);
    for (const std::string& note : geometry.notes) report.note(note);
}

/// One row a level: what it holds and what that takes.
void report_levels(Report& report,
                   const std::vector<VoxelGridInfo>& levels,
                   const std::vector<GridSummary>& grids) {
    Json list = Json::array();
    std::vector<std::vector<std::string>> rows;
    for (const VoxelGridInfo& info : levels) {
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
                        show_count(static_cast<double>(info.voxel_count)), show_fixed(lobes, 3),
                        show_bytes(static_cast<double>(bytes)), show_fixed(size, 1)});
    }
    report.table("levels", std::move(list),
                 {"levels", "voxels", "lobes per voxel", "size", "bytes per voxel"}, rows);
}

/// "a (int64), b (float)": the grids of level 0, the sums of masks as their number.
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

void report_volume(Report& report, const std::string& path) {
    const std::vector<VoxelGridInfo> levels = read_infos(path);
    for (const VoxelGridInfo& level : levels) {
        (void)read_vdb(path, level.level); // every voxel of every level is checked
    }
    const VoxelGridInfo& info = levels[0];
    const Vec3d size = info.lattice.voxel_size;
    report.text("name", info.name);
    report.add("voxel_size", "voxel size", to_json(size), show(size) + " scene units");
    report.count("subvoxels", info.lattice.subvoxels, "per voxel axis");
    report.count("voxels", info.voxel_count);
    report.count("lobes", info.lobe_count);
    report.add("most_lobes", "maximum lobes", info.max_lobes, str(info.max_lobes, " per voxel"));
    report_materials(report, info.materials);
    for (const YarnType& yarn : info.yarns) report.text("yarn", yarn.name);
    report.text("command", info.command);
    const std::vector<GridSummary> grids = summarize_vdb(path);
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
                   show_fixed(all, 1) + " bytes per voxel of level 0");
    }
    report.text("content hash", content_hash(grids));
}

void run_info(const Arguments& arguments, Report& report, ProgressBar& bar) {
    const std::string& path = arguments.text("FILE");
    report.text("file", path);
    bar.begin("read", "files", 1);
    if (suffix_of(path) == ".vdb") {
        report_volume(report, path);
    } else if (is_volume(arguments)) {
        report_vol(report, find_vol_layout(path));
    } else {
        report_input(report, path, arguments, bar);
    }
    std::error_code ignored;
    const std::uintmax_t size = std::filesystem::file_size(path, ignored);
    if (!ignored) report.bytes("file size", static_cast<std::int64_t>(size));
}

} // namespace

Command info_command() {
    return {"info", "Shows what a file contains and what voxelizing it would need.",
            joined({grouped("Input",
                            {{"FILE", "", "", any_text(), "",
                              "Any file that voxelize reads, or a .vdb written by heddle.", true}}),
                    resolution_options(), load_options(), model_options()}),
            run_info};
}

} // namespace heddle::cli
