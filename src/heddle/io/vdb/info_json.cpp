#include <heddle/base/error.h>
#include <heddle/io/vdb/info_json.h>
#include <heddle/io/vdb/vdb_format.h>

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

namespace heddle {
namespace {

using nlohmann::json;

constexpr std::array<const char*, 2> kMaterialKinds{"fiber", "surface"};
constexpr std::array<const char*, 3> kAlphaModes{"opaque", "mask", "blend"};
constexpr std::array<const char*, 3> kYarnModels{"solid", "procedural", "slice"};

// Each struct has one list of its fields, used by the writer and by the reader.
struct Writer {
    json out = json::object();

    template <typename T>
    void operator()(const char* key, const T& value) {
        out[key] = value;
    }
    template <typename T>
    void operator()(const char* key, const Vec3<T>& v) {
        out[key] = {v.x, v.y, v.z};
    }
    void operator()(const char* key, const MeanSd& v) { out[key] = {v.mean, v.sd}; }
    void where_known(const char* key, float value) {
        if (value > 0.0f) out[key] = value;
    }
    template <typename Enum, std::size_t N>
    void operator()(const char* key, const Enum& e, const std::array<const char*, N>& names) {
        out[key] = names.at(static_cast<std::size_t>(e));
    }
};

struct Reader {
    const json& in;

    void operator()(const char* key, float& value) const { value = number(in.at(key)); }
    /// For a key that some files lack.
    void where_known(const char* key, float& value) const {
        if (!in.contains(key)) return;
        const float v = number(in.at(key));
        value = v > 0.0f && std::isfinite(v) ? v : 0.0f;
    }
    void operator()(const char* key, double& value) const { value = in.at(key).get<double>(); }
    template <typename T>
    void operator()(const char* key, T& value) const {
        value = in.at(key).get<T>();
    }
    void operator()(const char* key, Vec3f& v) const {
        v = {number(in.at(key).at(0)), number(in.at(key).at(1)), number(in.at(key).at(2))};
    }
    void operator()(const char* key, Vec3d& v) const {
        const json& a = in.at(key);
        v = {a.at(0).get<double>(), a.at(1).get<double>(), a.at(2).get<double>()};
    }
    void operator()(const char* key, MeanSd& v) const {
        v = {number(in.at(key).at(0)), number(in.at(key).at(1))};
    }
    template <typename Enum, std::size_t N>
    void operator()(const char* key, Enum& e, const std::array<const char*, N>& names) const {
        const auto name = in.at(key).get<std::string>();
        for (std::size_t i = 0; i < N; ++i) {
            if (name == names[i]) {
                e = static_cast<Enum>(i);
                return;
            }
        }
        throw std::runtime_error(str("'", key, "' is '", name, "', which is not known"));
    }
    static float number(const json& value) { return static_cast<float>(value.get<double>()); }
};

template <typename Visitor, typename MaterialT>
void visit_material(Visitor& field, MaterialT& m) {
    field("name", m.name);
    field("kind", m.kind, kMaterialKinds);
    field("albedo", m.albedo);
    field("roughness", m.roughness);
    field("metalness", m.metalness);
    field("anisotropy", m.anisotropy);
    field("anisotropy_rotation", m.anisotropy_rotation);
    field("alpha_mode", m.alpha_mode, kAlphaModes);
    field("alpha", m.alpha);
    field("alpha_cutoff", m.alpha_cutoff);
    field("normal_scale", m.normal_scale);
    field("height_scale", m.height_scale);
    field("height_offset", m.height_offset);
    field.where_known("fiber_radius", m.fiber_radius);
}

template <typename Visitor, typename YarnT>
void visit_plies(Visitor& field, YarnT& y) {
    field("plies", y.plies);
    field("fibers_per_ply", y.fibers_per_ply);
    field("ply_clockwise", y.ply_clockwise);
    field("fiber_clockwise", y.fiber_clockwise);
    field("ply_pitch", y.ply_pitch);
    field("fiber_pitch", y.fiber_pitch);
    field("ply_offset", y.ply_offset);
    field("ellipse_long", y.ellipse_long);
    field("ellipse_short", y.ellipse_short);
    field("density_epsilon", y.density_epsilon);
    field("density_beta", y.density_beta);
    field("density_r_max", y.density_r_max);
    field("migration", y.migration);
    field("migration_frequency", y.migration_frequency);
    field("migration_min", y.migration_min);
    field("migration_max", y.migration_max);
}

template <typename Visitor, typename YarnT>
void visit_yarn(Visitor& field, YarnT& y) {
    field("name", y.name);
    field("model", y.model, kYarnModels);
    field("radius", y.radius);
    field("model_radius", y.model_radius);
    field("fiber_radius", y.fiber_radius);
    field("albedo", y.albedo);
    visit_plies(field, y);
    field("flyaways", y.flyaways);
    field("hair_density", y.hair_density);
    field("hair_ze", y.hair_ze);
    field("hair_r0", y.hair_r0);
    field("hair_re", y.hair_re);
    field("hair_pe", y.hair_pe);
    field("loop_density", y.loop_density);
    field("loop_r1", y.loop_r1);
    field("twist", y.twist);
    field("slice_fibers", y.slice_fibers);
}

template <typename Visitor, typename InfoT>
void visit_info(Visitor& field, InfoT& info) {
    field("name", info.name);
    field("voxel_size", info.lattice.voxel_size);
    field("subvoxels", info.lattice.subvoxels);
    field("max_lobes", info.max_lobes);
    field("command", info.command);
}

template <typename Visitor, typename InfoT>
void visit_counts(Visitor& field, InfoT& level) {
    field("voxel_count", level.voxel_count);
    field("lobe_count", level.lobe_count);
}

std::string dump(const json& value) { // names may not be UTF-8: a bad byte becomes U+FFFD
    return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

void add_counts(Writer& to, const LevelCounts& level, const Lattice& lattice) {
    visit_counts(to, level);
    if (level.voxel_count == 0) return;
    const Vec3d h = lattice.voxel_size;
    const Vec3i lo = level.lo, hi = level.hi;
    to("bounds_lo", Vec3d{lo.x * h.x, lo.y * h.y, lo.z * h.z});
    to("bounds_hi", Vec3d{(hi.x + 1.0) * h.x, (hi.y + 1.0) * h.y, (hi.z + 1.0) * h.z});
}

/// A level's info: `about`, shared by all levels, with the finest lattice, and its counts.
VoxelLevelInfo make_level(const VoxelLevelInfo& about, int level, const json& counts) {
    VoxelLevelInfo info = about;
    info.level = level;
    info.lattice = lattice_of_level(about.lattice, level);
    const Reader read{counts};
    visit_counts(read, info);
    if (info.voxel_count < 0 || info.lobe_count < info.voxel_count) {
        throw std::runtime_error(str("level ", level, " has ", info.voxel_count, " voxels and ",
                                     info.lobe_count, " lobes"));
    }
    return info;
}

void check_info(const VoxelLevelInfo& info) {
    for (int a = 0; a < 3; ++a) {
        const double h = info.lattice.voxel_size[a];
        if (!(std::isfinite(h) && h > 0.0)) {
            throw std::runtime_error(str("voxel size ", h, " (allowed: above 0)"));
        }
    }
    const std::int32_t s = info.lattice.subvoxels;
    if (s != 1 && s != 2 && s != 4 && s != 8) {
        throw std::runtime_error(str("subvoxels ", s, " (allowed: 1, 2, 4, 8)"));
    }
    if (info.max_lobes < 1 || info.max_lobes > 8) {
        throw std::runtime_error(str("max_lobes ", info.max_lobes, " (allowed: 1 to 8)"));
    }
    if (info.materials.size() > 256) {
        throw std::runtime_error(str(info.materials.size(), " materials (allowed: 256)"));
    }
}

} // namespace

std::string materials_to_json(const std::vector<Material>& materials) {
    json list = json::array();
    for (const Material& m : materials) {
        Writer one;
        visit_material(one, m);
        list.push_back(std::move(one.out));
    }
    return dump(list);
}

InfoJson to_json(const VoxelLevelInfo& finest, std::span<const LevelCounts> levels) {
    Writer about;
    visit_info(about, finest);
    add_counts(about, levels[0], finest.lattice); // of level 0, as in files of one level
    about("lod", finest.lod);
    about("approximate", finest.approximate);
    json list = json::array();
    for (std::size_t i = 0; i < levels.size(); ++i) {
        Writer one;
        add_counts(one, levels[i], lattice_of_level(finest.lattice, static_cast<int>(i)));
        list.push_back(std::move(one.out));
    }
    about("levels", list);
    json yarns = json::array();
    for (const YarnType& y : finest.yarns) {
        Writer one;
        visit_yarn(one, y);
        yarns.push_back(std::move(one.out));
    }
    return {dump(about.out), materials_to_json(finest.materials), dump(yarns)};
}

std::vector<VoxelLevelInfo> infos_from_json(const InfoJson& text, const std::string& path) {
    try {
        VoxelLevelInfo info;
        const json about = json::parse(text.info);
        const Reader read_info{about};
        visit_info(read_info, info);
        info.lod = about.value("lod", std::string());
        info.approximate = about.value("approximate", false);
        for (const json& one : json::parse(text.materials)) {
            const Reader read{one};
            visit_material(read, info.materials.emplace_back());
        }
        for (const json& one : json::parse(text.yarns)) {
            const Reader read{one};
            visit_yarn(read, info.yarns.emplace_back());
        }
        check_info(info);
        // older files without levels lack the list
        const json levels = about.contains("levels") ? about.at("levels") : json::array({about});
        if (!levels.is_array() || levels.empty() || levels.size() > kMaxLevels) {
            throw std::runtime_error(
                str(levels.size(), " levels (allowed: 1 to ", kMaxLevels, ")"));
        }
        std::vector<VoxelLevelInfo> infos;
        for (std::size_t i = 0; i < levels.size(); ++i) {
            infos.push_back(make_level(info, static_cast<int>(i), levels[i]));
        }
        return infos;
    } catch (const std::exception& e) { // those of nlohmann and our own
        throw Error(ErrorCode::BadFile, str("its heddle metadata cannot be used: ", e.what()),
                    "write the file again", {.path = path});
    }
}

} // namespace heddle
