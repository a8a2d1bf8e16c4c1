#include <heddle/surface/surface_maps.h>

#include <heddle/base/error.h>

#include <cmath>

namespace heddle {

namespace {

// Returns the texture alpha whose product with the material's alpha is the cut-off.
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

} // namespace

GeometryMaps::GeometryMaps(const Geometry& geometry, MapReading reading) : geometry_(geometry) {
    for (const Mesh& mesh : geometry.meshes)
        if (mesh.material >= geometry.materials.size())
            throw Error(
                ErrorCode::InvalidArgument,
                str("a mesh names material ", mesh.material, " of ", geometry.materials.size()),
                "give every mesh a material of the geometry");
    for (const Material& m : geometry.materials) materials_.push_back(make_maps(m, reading));
}

const TextureView*
GeometryMaps::store(std::int32_t texture, TexelWeight weight, float threshold, bool levels) {
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

SurfaceMaps GeometryMaps::make_maps(const Material& m, MapReading reading) {
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
    const bool averaged = reading == MapReading::Footprint;
    const TexelWeight weight = albedo_weight(m);
    const float threshold = weight == TexelWeight::Mask ? mask_threshold(m) : 0.0f;
    maps.albedo = store(m.albedo_map, weight, threshold, averaged);
    maps.normal = store(m.normal_map, TexelWeight::One, 0.0f, false);
    maps.metal_rough = store(m.metal_rough_map, TexelWeight::One, 0.0f, averaged);
    if (maps.anisotropic || !averaged) // a traced material may be another, and be anisotropic
        maps.anisotropy = store(m.anisotropy_map, TexelWeight::One, 0.0f, averaged);
    if (moves_surface(m) && averaged)
        maps.height = store(m.height_map, TexelWeight::One, 0.0f, averaged);
    return maps;
}

std::int64_t GeometryMaps::bytes() const {
    std::int64_t sum = 0;
    for (const Stored& s : stored_) sum += s.filtered->bytes();
    return sum;
}

MeshView mesh_view(const Mesh& mesh) {
    MeshView view;
    view.positions = mesh.positions.data();
    view.normals = data_or_null(mesh.normals);
    view.tangents = data_or_null(mesh.tangents);
    view.uvs = data_or_null(mesh.uvs);
    view.triangles = mesh.triangles.data();
    view.vertex_count = mesh.positions.size();
    view.material = mesh.material;
    return view;
}

} // namespace heddle
