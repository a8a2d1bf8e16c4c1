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

void report_curves(Report& report, const job::CurveSummary& curves) {
    const CurveStats& sum = curves.sum;
    std::string bases;
    for (const Basis basis : curves.bases) bases += (bases.empty() ? "" : ", ") + basis_name(basis);
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
}

void report_meshes(Report& report, const job::MeshSummary& meshes) {
    report.count("meshes", meshes.meshes);
    report.count("triangles", meshes.triangles);
    report.count("vertices", meshes.vertices);
    std::string with = meshes.normals ? "normals" : "";
    if (meshes.tangents) with += with.empty() ? "tangents" : ", tangents";
    if (meshes.uvs) with += with.empty() ? "uv" : ", uv";
    with = with.empty() ? "positions" : with;
    report.add("all_have", "vertex data", with, with + (meshes.meshes > 1 ? " in every mesh" : ""));
}

void report_textures(Report& report, const std::vector<job::TextureSummary>& textures) {
    Json list = Json::array();
    std::int64_t bytes = 0;
    for (const job::TextureSummary& texture : textures) {
        list.push_back({{"name", texture.name},
                        {"width", texture.width},
                        {"height", texture.height},
                        {"channels", texture.channels}});
        bytes += texture.bytes;
    }
    report.add("textures", "textures", std::move(list),
               textures.empty()
                   ? "none"
                   : str(textures.size(), ", ", format_bytes(static_cast<double>(bytes))));
}

void report_plan(Report& report, const job::GeometryInfo& info) {
    if (!info.plan) return report.add("voxelizing", "cannot voxelize", info.why_not, info.why_not);
    const Vec3d size = info.plan->lattice.voxel_size;
    const Vec3i n = info.plan->voxel_hi - info.plan->voxel_lo;
    report.add("voxel_size", "voxel size", to_json(size),
               str(show(size), " scene units: ", n.x, " x ", n.y, " x ", n.z, " voxels"));
    report_work(report, *info.plan, info.predicted_file_bytes);
}

} // namespace

void report_geometry(Report& report, const job::GeometryInfo& info) {
    if (info.curves) report_curves(report, *info.curves);
    if (info.meshes) report_meshes(report, *info.meshes);
    report_bounds(report, info.bounds);
    for (const job::YarnSummary& yarn : info.yarns) {
        report.text("yarn", yarn.name);
        report.count("fibers", yarn.fibers, "per yarn");
    }
    report_material_names(report, info.materials);
    report_textures(report, info.textures);
    report_plan(report, info);
    report_notes(report, info.notes);
}

} // namespace heddle::cli
