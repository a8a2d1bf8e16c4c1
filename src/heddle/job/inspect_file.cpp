#include <heddle/job/inspect_file.h>

#include <heddle/io/file/input_file.h>
#include <heddle/io/vdb/predict_vdb.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/job/levels.h>
#include <heddle/job/option_error.h>
#include <heddle/job/phase_clock.h>
#include <heddle/job/write_output.h>

#include <algorithm>
#include <utility>

namespace heddle::job {
namespace {

CurveSummary summarize_curves(const std::vector<CurveSet>& sets) {
    CurveSummary out;
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const CurveStats one = measure(sets[i]);
        CurveStats& sum = out.sum;
        sum.curves += one.curves;
        sum.points += one.points;
        sum.spans += one.spans;
        sum.closed += one.closed;
        sum.length += one.length;
        sum.radius_min = i == 0 ? one.radius_min : std::min(sum.radius_min, one.radius_min);
        sum.radius_max = std::max(sum.radius_max, one.radius_max);
        if (!one.bounds.empty()) {
            sum.bounds.grow(one.bounds);
            out.bounds.grow(one.bounds.lo, double{one.radius_max});
            out.bounds.grow(one.bounds.hi, double{one.radius_max});
        }
        const bool known =
            std::find(out.bases.begin(), out.bases.end(), sets[i].basis) != out.bases.end();
        if (!known) out.bases.push_back(sets[i].basis);
    }
    return out;
}

MeshSummary summarize_meshes(const std::vector<Mesh>& meshes) {
    MeshSummary out;
    out.meshes = static_cast<std::int64_t>(meshes.size());
    for (const Mesh& mesh : meshes) {
        out.triangles += static_cast<std::int64_t>(mesh.triangles.size());
        out.vertices += static_cast<std::int64_t>(mesh.positions.size());
        out.normals = out.normals && !mesh.normals.empty();
        out.tangents = out.tangents && !mesh.tangents.empty();
        out.uvs = out.uvs && !mesh.uvs.empty();
        for (const Vec3f p : mesh.positions) out.bounds.grow(to_double(p));
    }
    return out;
}

VoxelizeOptions plan_options(const InspectOptions& options) {
    if (options.voxel_size && options.voxels) {
        throw OptionError("`voxel_size` and `voxels` both set the resolution; give one of them");
    }
    VoxelizeOptions out;
    out.voxels = options.voxels.value_or(512);
    out.voxel_size = options.voxel_size.value_or(Vec3d{});
    out.writer_bytes = kVdbWriterBytes;
    out.writer_bytes_per_leaf = kVdbWriterBytesPerLeaf;
    return out;
}

/// Adds the plan of a voxelization, or one line that says why there is none.
void plan_in(GeometryInfo& info,
             const Geometry& geometry,
             const VoxelizeOptions& options,
             const Progress& progress) {
    try {
        info.plan = plan_voxelize(geometry, options, progress);
        info.predicted_file_bytes = predict_file_bytes(*info.plan);
    } catch (const Error& e) {
        if (e.code() == ErrorCode::Cancelled) throw;
        info.why_not = e.what();
    }
}

/// Returns the name of an option that is given and concerns curves and meshes alone; "": none.
const char* given_option(const InspectOptions& options) {
    const GeometryOptions& g = options.geometry;
    const std::pair<bool, const char*> all[] = {
        {options.voxel_size.has_value(), "voxel_size"},
        {options.voxels.has_value(), "voxels"},
        {g.yarn.has_value(), "yarn"},
        {g.yarn_radius.has_value(), "yarn_radius"},
        {g.repeat_x != 1 || g.repeat_y != 1, "repeat"},
        {g.fibers.has_value(), "fibers"},
        {g.fiber_radius.has_value(), "fiber_radius"},
        {g.height_map.has_value(), "height_map"},
        {g.height_scale.has_value(), "height_scale"},
        {g.height_offset.has_value(), "height_offset"},
    };
    for (const auto& [given, name] : all) {
        if (given) return name;
    }
    return "";
}

void refuse_options(const InspectOptions& options, const std::string& suffix) {
    const std::string name = given_option(options);
    if (name.empty()) return;
    throw OptionError(str("`", name, "` cannot be used with a ", suffix,
                          ", which holds voxels; it needs curves or meshes"));
}

VolumeInfo inspect_volume(const std::string& path, const Progress& progress) {
    VolumeInfo info;
    info.levels = read_infos(path);
    for (const VoxelLevelInfo& level : info.levels) {
        (void)read_vdb(path, level.level); // every voxel of every level is checked
        progress.check();
    }
    info.grids = summarize_vdb(path);
    info.content_hash = content_hash(info.grids);
    return info;
}

} // namespace

GeometryInfo
inspect_geometry(GeometryInput input, const InspectOptions& options, Progress& progress) {
    const VoxelizeOptions asked = plan_options(options);
    const Geometry geometry = load_geometry(std::move(input));
    progress.check();
    GeometryInfo info;
    if (!geometry.curves.empty()) info.curves = summarize_curves(geometry.curves);
    if (!geometry.meshes.empty()) info.meshes = summarize_meshes(geometry.meshes);
    if (info.curves) info.bounds.grow(info.curves->bounds);
    if (info.meshes) info.bounds.grow(info.meshes->bounds);
    for (const YarnType& yarn : geometry.yarns) {
        info.yarns.push_back({yarn.name, yarn.fiber_count()});
    }
    info.materials = geometry.materials;
    for (const Texture& t : geometry.textures) {
        info.textures.push_back(
            {t.name, t.width, t.height, t.channels, static_cast<std::int64_t>(t.texels.size())});
    }
    plan_in(info, geometry, asked, progress);
    take_notes(info.notes, geometry.notes, progress);
    return info;
}

FileInfo inspect_file(const std::string& path, const InspectOptions& options, Progress& progress) {
    FileInfo info{path, 0, {}};
    progress.begin("read", "files", 1);
    const std::string suffix = suffix_of(path);
    if (suffix == ".vdb" || suffix == ".vol") refuse_options(options, suffix);
    if (suffix == ".vdb") {
        info.content = inspect_volume(path, progress);
    } else if (suffix == ".vol") {
        info.content = find_vol_layout(path);
    } else {
        info.content =
            inspect_geometry({.path = path, .options = options.geometry}, options, progress);
    }
    info.file_bytes = file_bytes(path);
    return info;
}

} // namespace heddle::job
