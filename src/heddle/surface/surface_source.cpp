#include <heddle/surface/surface_source.h>

#include <heddle/base/error.h>
#include <heddle/surface/average_normals.h>

#include <algorithm>
#include <cmath>

namespace heddle {

namespace {

/// Neighbouring hits in a voxel that share a sample of the maps: a quarter of the cost of a sample
/// per hit, with still 16 samples per voxel and axis.
constexpr int kMaxRun = 4;

// Returns the level of the height map for the mean footprint of the mesh's hits.
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
    : geometry_(geometry), maps_(geometry, MapReading::Footprint), first_(1, 0) {
    view_.seed = seed;
    view_.subvoxel_size = subvoxel_size;
    view_.run = run;
    normals_.reserve(geometry.meshes.size());
    for (const Mesh& mesh : geometry.meshes) add_mesh(mesh);
    view_.meshes = meshes_.data();
    view_.first_triangle = first_.data();
    view_.materials = maps_.materials().data();
    view_.mesh_count = meshes_.size();
    view_.triangle_count = first_.back();
    view_.material_count = static_cast<std::uint32_t>(maps_.materials().size());
}

SurfaceSource::SurfaceSource(const Geometry& geometry,
                             const LatticeUnits& units,
                             std::uint64_t seed)
    : SurfaceSource(
          geometry, units.voxel_size * (1.0 / units.n), seed, std::min(units.n, kMaxRun)) {}

void SurfaceSource::add_mesh(const Mesh& mesh) {
    const SurfaceMaps& m = maps_.of(mesh);
    MeshView view = mesh_view(mesh);
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
