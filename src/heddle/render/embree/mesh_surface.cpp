#include <heddle/render/embree/mesh_surface.h>

#include <heddle/base/error.h>

#include <array>
#include <cmath>

namespace heddle {
namespace {

void check_mesh(const Geometry& geometry, const Mesh& mesh) {
    const std::size_t n = mesh.positions.size();
    if (mesh.material >= geometry.materials.size()) {
        throw Error(ErrorCode::InvalidArgument,
                    str("a mesh names material ", mesh.material, " of ", geometry.materials.size()),
                    "give every mesh a material of the geometry");
    }
    const auto fits = [&](std::size_t size) { return size == 0 || size == n; };
    bool inside = fits(mesh.normals.size()) && fits(mesh.tangents.size()) && fits(mesh.uvs.size());
    for (const auto& corners : mesh.triangles) {
        for (const std::uint32_t c : corners) inside = inside && c < n;
    }
    if (!inside) {
        throw Error(ErrorCode::InvalidArgument,
                    str("a mesh of ", n, " vertices names others or has arrays of other lengths"),
                    "give vertex arrays one length and triangles indices below it");
    }
}

/// Weights a corner array's values.
template <typename T>
T blend(const std::vector<T>& v, const std::array<std::uint32_t, 3>& c, TrianglePoint at) {
    return v[c[0]] * (1.0f - at.u - at.v) + v[c[1]] * at.u + v[c[2]] * at.v;
}

Uv uv_at(const Mesh& mesh, TrianglePoint at) {
    const auto& c = mesh.triangles[at.triangle];
    const float w = 1.0f - at.u - at.v;
    const Uv a = mesh.uvs[c[0]], b = mesh.uvs[c[1]], d = mesh.uvs[c[2]];
    return {a.u * w + b.u * at.u + d.u * at.v, a.v * w + b.v * at.u + d.v * at.v};
}

/// A direction along the surface with the sign of the bitangent.
struct Along {
    Vec3f direction;
    float handedness = 1.0f;
};

/// Where u grows on the triangle.                        as in surface/surface_op.h
Along along_u(const Mesh& mesh, std::uint32_t triangle, Vec3f normal) {
    const auto& c = mesh.triangles[triangle];
    if (mesh.uvs.empty()) return {any_perpendicular(normal), 1.0f};
    const Vec3f d1 = mesh.positions[c[1]] - mesh.positions[c[0]];
    const Vec3f d2 = mesh.positions[c[2]] - mesh.positions[c[0]];
    const float u1 = mesh.uvs[c[1]].u - mesh.uvs[c[0]].u;
    const float v1 = mesh.uvs[c[1]].v - mesh.uvs[c[0]].v;
    const float u2 = mesh.uvs[c[2]].u - mesh.uvs[c[0]].u;
    const float v2 = mesh.uvs[c[2]].v - mesh.uvs[c[0]].v;
    const float sign = u1 * v2 - u2 * v1 < 0.0f ? -1.0f : 1.0f;
    return {normalize((d1 * v2 - d2 * v1) * sign, any_perpendicular(normal)), sign};
}

Along vertex_tangent(const Mesh& mesh, TrianglePoint at) {
    const auto& c = mesh.triangles[at.triangle];
    const float weight[3] = {1.0f - at.u - at.v, at.u, at.v};
    Along along{{}, mesh.tangents[c[0]].w < 0.0f ? -1.0f : 1.0f};
    for (std::size_t i = 0; i < 3; ++i) {
        const Tangent& t = mesh.tangents[c[i]];
        along.direction = along.direction + Vec3f{t.x, t.y, t.z} * weight[i];
    }
    return along;
}

Vec3f face_normal(const Mesh& mesh, std::uint32_t triangle) {
    const auto& c = mesh.triangles[triangle];
    const Vec3d p = to_double(mesh.positions[c[0]]);
    return to_float(
        normalize(cross(to_double(mesh.positions[c[1]]) - p, to_double(mesh.positions[c[2]]) - p)));
}

bool displaces(const Material& m) {
    return m.height_map >= 0 && (m.height_scale != 0.0f || m.height_offset != 0.0f);
}

} // namespace

MeshSurfaces::MeshSurfaces(const Geometry& geometry) : geometry_(geometry) {
    for (const Mesh& mesh : geometry.meshes) {
        check_mesh(geometry, mesh);
        if (displaces(geometry.materials[mesh.material])) {
            throw Error(ErrorCode::Unsupported,
                        str("material '", geometry.materials[mesh.material].name,
                            "' displaces its surface by a height map, which is not traced"),
                        "leave the height map out, or render its volume");
        }
    }
    for (const Material& m : geometry.materials) maps_.push_back(make_maps(m));
}

const FilteredTexture*
MeshSurfaces::add_texture(std::int32_t index, TexelWeight weight, float threshold, bool levels) {
    if (index < 0) return nullptr;
    if (static_cast<std::size_t>(index) >= geometry_.textures.size()) {
        throw Error(ErrorCode::InvalidArgument,
                    str("a material names texture ", index, " of ", geometry_.textures.size()),
                    "give every map a texture of the geometry, or -1");
    }
    const Texture& texture = geometry_.textures[static_cast<std::size_t>(index)];
    textures_.push_back(std::make_unique<FilteredTexture>(texture, weight, threshold, levels));
    return textures_.back().get();
}

MeshSurfaces::Maps MeshSurfaces::make_maps(const Material& m) {
    Maps maps;
    const TexelWeight weight = m.alpha_mode == AlphaMode::Opaque ? TexelWeight::One
                               : m.alpha_mode == AlphaMode::Mask ? TexelWeight::Mask
                                                                 : TexelWeight::Alpha;
    // the texture's alpha at which its product with the material's reaches the cut-off
    const float threshold = m.alpha_cutoff <= 0.0f ? 0.0f
                            : m.alpha > 0.0f       ? m.alpha_cutoff / m.alpha
                                                   : 2.0f;
    const bool cut = weight != TexelWeight::One;
    maps.albedo = add_texture(m.albedo_map, weight, cut ? threshold : 0.0f, cut);
    maps.normal = add_texture(m.normal_map, TexelWeight::One, 0.0f, false);
    maps.metal_rough = add_texture(m.metal_rough_map, TexelWeight::One, 0.0f, false);
    maps.anisotropy = add_texture(m.anisotropy_map, TexelWeight::One, 0.0f, false);
    maps.rotation_cos = std::cos(m.anisotropy_rotation);
    maps.rotation_sin = std::sin(m.anisotropy_rotation);
    return maps;
}

bool MeshSurfaces::has_alpha(std::size_t mesh) const {
    return geometry_.materials[geometry_.meshes[mesh].material].alpha_mode != AlphaMode::Opaque;
}

float MeshSurfaces::alpha(std::size_t index, TrianglePoint at) const {
    const Mesh& mesh = geometry_.meshes[index];
    const Material& m = geometry_.materials[mesh.material];
    const FilteredTexture* map = mesh.uvs.empty() ? nullptr : maps_[mesh.material].albedo;
    if (m.alpha_mode == AlphaMode::Mask) {
        if (map == nullptr) return m.alpha >= m.alpha_cutoff ? 1.0f : 0.0f;
        return map->coverage_at_point(uv_at(mesh, at));
    }
    return m.alpha * (map == nullptr ? 1.0f : map->at_point(uv_at(mesh, at)).a);
}

MeshSurfaces::Frame MeshSurfaces::frame(const Mesh& mesh, TrianglePoint at) const {
    const Vec3f face = face_normal(mesh, at.triangle);
    Frame f;
    f.normal = mesh.normals.empty()
                   ? face
                   : normalize(blend(mesh.normals, mesh.triangles[at.triangle], at), face);
    const Along along =
        mesh.tangents.empty() ? along_u(mesh, at.triangle, face) : vertex_tangent(mesh, at);
    f.tangent = normalize(along.direction - f.normal * dot(f.normal, along.direction),
                          any_perpendicular(f.normal));
    f.bitangent = cross(f.normal, f.tangent) * along.handedness;
    return f;
}

MeshSample MeshSurfaces::sample(std::size_t index, TrianglePoint at) const {
    const Mesh& mesh = geometry_.meshes[index];
    const Material& m = geometry_.materials[mesh.material];
    const Maps& maps = maps_[mesh.material];
    const Frame f = frame(mesh, at);
    MeshSample s;
    s.normal = f.normal;
    float x = 1.0f, y = 0.0f; // direction of anisotropy in the tangent frame
    if (!mesh.uvs.empty()) {
        const Uv uv = uv_at(mesh, at);
        if (maps.albedo != nullptr) {
            const Rgba c = m.alpha_mode == AlphaMode::Opaque ? maps.albedo->at_point(uv)
                                                             : maps.albedo->filtered(uv, 0.0f);
            s.albedo = {c.r, c.g, c.b};
        }
        if (maps.metal_rough != nullptr) {
            const Rgba c = maps.metal_rough->at_point(uv);
            s.roughness = c.g;
            s.metalness = c.b;
        }
        if (maps.normal != nullptr) {
            const Rgba c = maps.normal->at_point(uv);
            s.normal = normalize(f.tangent * ((2.0f * c.r - 1.0f) * m.normal_scale) +
                                     f.bitangent * ((2.0f * c.g - 1.0f) * m.normal_scale) +
                                     f.normal * (2.0f * c.b - 1.0f),
                                 f.normal);
        }
        if (maps.anisotropy != nullptr) {
            const Rgba c = maps.anisotropy->at_point(uv);
            s.anisotropy = c.b;
            x = 2.0f * c.r - 1.0f;
            y = 2.0f * c.g - 1.0f;
        }
    }
    const Vec3f direction = f.tangent * (x * maps.rotation_cos - y * maps.rotation_sin) +
                            f.bitangent * (x * maps.rotation_sin + y * maps.rotation_cos);
    s.tangent = normalize(direction, f.tangent);
    return s;
}

std::int64_t MeshSurfaces::byte_count() const {
    std::int64_t sum = 0;
    for (const auto& texture : textures_) sum += texture->bytes();
    return sum;
}

} // namespace heddle
