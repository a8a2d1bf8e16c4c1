#include <heddle/surface/surface_source.h>

#include <heddle/base/error.h>
#include <heddle/surface/average_normals.h>

#include <algorithm>
#include <cmath>

namespace heddle {

namespace {

/// Neighbouring hits in a voxel that share a sample of the maps: a quarter of the cost of reading
/// them at each, and still 16 samples a voxel and axis.
constexpr int kMostRun = 4;

bool moves(const Material& m) {
    return m.height_scale != 0.0f || m.height_offset != 0.0f;
}

// The alpha of the texture at which the product with the material's alpha reaches the cut-off.
float mask_threshold(const Material& m) {
    if (m.alpha_cutoff <= 0.0f) return 0.0f;
    return m.alpha > 0.0f ? m.alpha_cutoff / m.alpha : 2.0f;
}

TexelWeight albedo_weight(const Material& m) {
    return m.alpha_mode == AlphaMode::Opaque ? TexelWeight::One
           : m.alpha_mode == AlphaMode::Mask ? TexelWeight::Mask
                                             : TexelWeight::Alpha;
}

template <typename T>
const T* data_or_null(const std::vector<T>& v) {
    return v.empty() ? nullptr : v.data();
}

// Level of the height map at the mean footprint of the mesh's hits.
float height_level(const Mesh& mesh, const TextureView& map, Vec3d subvoxel_size) {
    double world = 0.0, in_uv = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3d p = to_double(mesh.positions[a]);
        world +=
            0.5 * length(cross(to_double(mesh.positions[b]) - p, to_double(mesh.positions[c]) - p));
        in_uv += surface_detail::uv_area(mesh.uvs[a], mesh.uvs[b], mesh.uvs[c]);
    }
    const double third = 1.0 / 3.0;
    const double area =
        third * (subvoxel_size.y * subvoxel_size.z + subvoxel_size.z * subvoxel_size.x +
                 subvoxel_size.x * subvoxel_size.y);
    return world > 0.0 ? map.level_of(static_cast<float>(std::sqrt(in_uv / world * area))) : 0.0f;
}

} // namespace

SurfaceSource::SurfaceSource(const Geometry& geometry,
                             Vec3d subvoxel_size,
                             std::uint64_t seed,
                             std::int32_t run)
    : geometry_(geometry), first_(1, 0) {
    for (const Mesh& mesh : geometry.meshes)
        if (mesh.material >= geometry.materials.size())
            throw Error(
                ErrorCode::InvalidArgument,
                str("a mesh names material ", mesh.material, " of ", geometry.materials.size()),
                "give every mesh a material of the geometry");
    for (const Material& m : geometry.materials) maps_.push_back(make_maps(m));
    view_.seed = seed;
    view_.subvoxel_size = subvoxel_size;
    view_.run = run;
    normals_.reserve(geometry.meshes.size());
    for (const Mesh& mesh : geometry.meshes) add_mesh(mesh);
    view_.meshes = meshes_.data();
    view_.first_triangle = first_.data();
    view_.materials = maps_.data();
    view_.mesh_count = meshes_.size();
    view_.triangle_count = first_.back();
    view_.material_count = static_cast<std::uint32_t>(maps_.size());
}

SurfaceSource::SurfaceSource(const Geometry& geometry,
                             const LatticeUnits& units,
                             std::uint64_t seed)
    : SurfaceSource(
          geometry, units.voxel_size * (1.0 / units.n), seed, std::min(units.n, kMostRun)) {}

void SurfaceSource::add_mesh(const Mesh& mesh) {
    const SurfaceMaps& m = maps_[mesh.material];
    MeshView view;
    view.positions = mesh.positions.data();
    view.normals = data_or_null(mesh.normals);
    view.tangents = data_or_null(mesh.tangents);
    view.uvs = data_or_null(mesh.uvs);
    view.triangles = mesh.triangles.data();
    view.vertex_count = mesh.positions.size();
    view.material = mesh.material;
    const bool displaced = m.height != nullptr && !mesh.uvs.empty();
    const bool mapped = m.albedo != nullptr || m.normal != nullptr || m.metal_rough != nullptr;
    const bool shaded = !mesh.normals.empty() || m.anisotropic || (mapped && !mesh.uvs.empty()) ||
                        m.alpha_mode != AlphaMode::Opaque;
    view.kind = displaced ? SurfaceKind::Displaced
                : shaded  ? SurfaceKind::Shaded
                          : SurfaceKind::Constant;
    normals_.push_back(displaced && mesh.normals.empty() ? average_normals(mesh)
                                                         : std::vector<Vec3f>{});
    if (displaced) {
        view.move_normals = mesh.normals.empty() ? normals_.back().data() : mesh.normals.data();
        view.height_level = height_level(mesh, *m.height, view_.subvoxel_size);
        view.displacement = max_displacement(geometry_, mesh);
    }
    meshes_.push_back(view);
    first_.push_back(first_.back() + mesh.triangles.size());
}

const TextureView*
SurfaceSource::stored(std::int32_t texture, TexelWeight weight, float threshold, bool levels) {
    if (texture < 0) return nullptr;
    if (static_cast<std::size_t>(texture) >= geometry_.textures.size())
        throw Error(ErrorCode::InvalidArgument,
                    str("a material names texture ", texture, " of ", geometry_.textures.size()),
                    "drop the map or add the texture");
    for (const Stored& s : stored_)
        if (s.texture == texture && s.weight == weight && s.threshold == threshold &&
            s.levels == levels)
            return &s.filtered->view();
    const Texture& t = geometry_.textures[static_cast<std::size_t>(texture)];
    stored_.push_back({texture, weight, threshold, levels,
                       std::make_unique<FilteredTexture>(t, weight, threshold, levels)});
    return &stored_.back().filtered->view();
}

SurfaceMaps SurfaceSource::make_maps(const Material& m) {
    SurfaceMaps maps;
    maps.anisotropic = m.kind == MaterialKind::Surface && m.anisotropy > 0.0f;
    maps.rotation_cos = std::cos(m.anisotropy_rotation);
    maps.rotation_sin = std::sin(m.anisotropy_rotation);
    maps.alpha = m.alpha;
    maps.alpha_cutoff = m.alpha_cutoff;
    maps.alpha_mode = m.alpha_mode;
    maps.normal_scale = m.normal_scale;
    maps.height_scale = m.height_scale;
    maps.height_offset = m.height_offset;
    const TexelWeight weight = albedo_weight(m);
    const float threshold = weight == TexelWeight::Mask ? mask_threshold(m) : 0.0f;
    maps.albedo = stored(m.albedo_map, weight, threshold, true);
    maps.normal = stored(m.normal_map, TexelWeight::One, 0.0f, false);
    maps.metal_rough = stored(m.metal_rough_map, TexelWeight::One, 0.0f, true);
    if (maps.anisotropic) maps.anisotropy = stored(m.anisotropy_map, TexelWeight::One, 0.0f, true);
    if (moves(m)) maps.height = stored(m.height_map, TexelWeight::One, 0.0f, true);
    return maps;
}

std::int64_t SurfaceSource::bytes() const {
    std::int64_t sum = 0;
    for (const Stored& s : stored_) sum += s.filtered->bytes();
    return sum;
}

std::int64_t SurfaceSource::predict_bytes(const Geometry& geometry) {
    std::int64_t sum = 0;
    for (const Material& m : geometry.materials)
        for (const std::int32_t map :
             {m.albedo_map, m.metal_rough_map, m.anisotropy_map, m.height_map})
            if (map >= 0 && static_cast<std::size_t>(map) < geometry.textures.size()) {
                const Texture& t = geometry.textures[static_cast<std::size_t>(map)];
                sum += FilteredTexture::predict_bytes(t.width, t.height);
            }
    for (const Mesh& mesh : geometry.meshes)
        if (geometry.materials[mesh.material].height_map >= 0 && mesh.normals.empty())
            sum += static_cast<std::int64_t>(mesh.positions.size() * sizeof(Vec3f));
    return sum;
}

double max_displacement(const Material& material, const Texture& height_map) {
    const FilteredTexture map(height_map, TexelWeight::One, 0.0f, false);
    double most = 0.0;
    for (const float h : map.red_range())
        most = std::max(most, std::abs(double{material.height_offset} +
                                       double{material.height_scale} * double{h}));
    return most;
}

double max_displacement(const Geometry& geometry, const Mesh& mesh) {
    const Material& m = geometry.materials[mesh.material];
    const auto map = static_cast<std::size_t>(m.height_map);
    if (m.height_map < 0 || map >= geometry.textures.size() || mesh.uvs.empty()) return 0.0;
    return max_displacement(m, geometry.textures[map]) * (1.0 + 1e-6);
}

} // namespace heddle
