#include <heddle/voxel/surface_sample.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/base/random.h>

#include <algorithm>
#include <cmath>

namespace heddle {

namespace {

Vec3f interpolate(const std::array<Vec3f, 3>& v, const SurfaceHit& h) {
    return v[0] * h.b0 + v[1] * h.b1 + v[2] * h.b2;
}

double uv_area(Uv a, Uv b, Uv c) {
    const double u1 = double{b.u} - double{a.u}, v1 = double{b.v} - double{a.v};
    const double u2 = double{c.u} - double{a.u}, v2 = double{c.v} - double{a.v};
    return 0.5 * std::abs(u1 * v2 - u2 * v1);
}

std::uint64_t hash_of(const SurfaceHit& h, std::uint64_t seed, std::uint64_t draw) {
    const auto word = [](std::int32_t i) { return std::uint64_t{static_cast<std::uint32_t>(i)}; };
    const std::uint64_t salt = 4 * draw + static_cast<std::uint64_t>(h.axis);
    return hash64(seed ^ (salt << 40), word(h.i) << 32 | word(h.j), word(h.k));
}

// Mean area of the surface that a hit stands for: the columns' sections seen from the surface,
// weighted as the axes share out the area.
double hit_area(Vec3d n, Vec3d s) {
    return n.x * n.x * s.y * s.z + n.y * n.y * s.z * s.x + n.z * n.z * s.x * s.y;
}

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

} // namespace

SurfaceSampler::SurfaceSampler(const Geometry& geometry,
                               Vec3d subvoxel_size,
                               std::uint64_t seed,
                               std::int32_t run)
    : geometry_(&geometry), subvoxel_size_(subvoxel_size), seed_(seed), run_(run) {
    for (const Mesh& mesh : geometry.meshes)
        if (mesh.material >= geometry.materials.size())
            throw Error(
                ErrorCode::InvalidArgument,
                str("a mesh names material ", mesh.material, " of ", geometry.materials.size()),
                "give every mesh a material of the geometry");
    for (const Material& m : geometry.materials) maps_.push_back(make_maps(m));
    for (const Mesh& mesh : geometry.meshes) {
        const SurfaceMaps& maps = maps_[mesh.material];
        height_levels_.push_back(0.0f);
        if (maps.height == nullptr || mesh.uvs.empty()) continue;
        double world = 0.0, in_uv = 0.0;
        for (const auto& [a, b, c] : mesh.triangles) {
            const Vec3d p = to_double(mesh.positions[a]);
            world += 0.5 * length(cross(to_double(mesh.positions[b]) - p,
                                        to_double(mesh.positions[c]) - p));
            in_uv += uv_area(mesh.uvs[a], mesh.uvs[b], mesh.uvs[c]);
        }
        const double third = 1.0 / 3.0;
        const double area =
            third * (subvoxel_size.y * subvoxel_size.z + subvoxel_size.z * subvoxel_size.x +
                     subvoxel_size.x * subvoxel_size.y);
        if (world > 0.0)
            height_levels_.back() =
                maps.height->level_of(static_cast<float>(std::sqrt(in_uv / world * area)));
    }
}

const FilteredTexture*
SurfaceSampler::stored(std::int32_t texture, TexelWeight weight, float threshold, bool levels) {
    if (texture < 0) return nullptr;
    if (static_cast<std::size_t>(texture) >= geometry_->textures.size())
        throw Error(ErrorCode::InvalidArgument,
                    str("a material names texture ", texture, " of ", geometry_->textures.size()),
                    "drop the map or add the texture");
    for (const Stored& s : stored_)
        if (s.texture == texture && s.weight == weight && s.threshold == threshold &&
            s.levels == levels)
            return s.filtered.get();
    const Texture& t = geometry_->textures[static_cast<std::size_t>(texture)];
    stored_.push_back({texture, weight, threshold, levels,
                       std::make_unique<FilteredTexture>(t, weight, threshold, levels)});
    return stored_.back().filtered.get();
}

SurfaceMaps SurfaceSampler::make_maps(const Material& m) {
    SurfaceMaps maps;
    maps.material = &m;
    maps.anisotropic = m.kind == MaterialKind::Surface && m.anisotropy > 0.0f;
    maps.rotation_cos = std::cos(m.anisotropy_rotation);
    maps.rotation_sin = std::sin(m.anisotropy_rotation);
    const TexelWeight weight = albedo_weight(m);
    const float threshold = weight == TexelWeight::Mask ? mask_threshold(m) : 0.0f;
    maps.albedo = stored(m.albedo_map, weight, threshold, true);
    maps.normal = stored(m.normal_map, TexelWeight::One, 0.0f, false);
    maps.metal_rough = stored(m.metal_rough_map, TexelWeight::One, 0.0f, true);
    if (maps.anisotropic) maps.anisotropy = stored(m.anisotropy_map, TexelWeight::One, 0.0f, true);
    if (moves(m)) maps.height = stored(m.height_map, TexelWeight::One, 0.0f, true);
    return maps;
}

bool SurfaceSampler::is_constant(const Mesh& mesh) const {
    const SurfaceMaps& m = maps_[mesh.material];
    const bool mapped = m.albedo != nullptr || m.normal != nullptr || m.metal_rough != nullptr ||
                        m.height != nullptr;
    return mesh.normals.empty() && !m.anisotropic && (!mapped || mesh.uvs.empty()) &&
           m.material->alpha_mode == AlphaMode::Opaque;
}

bool SurfaceSampler::is_displaced(const Mesh& mesh) const {
    return maps_[mesh.material].height != nullptr && !mesh.uvs.empty();
}

HeightLookup SurfaceSampler::height_of(const Mesh& mesh) const {
    const SurfaceMaps& maps = maps_[mesh.material];
    const auto index = static_cast<std::size_t>(&mesh - geometry_->meshes.data());
    return {maps.height, height_levels_[index], maps.material->height_scale,
            maps.material->height_offset};
}

TriangleSetup SurfaceSampler::setup(const Mesh& mesh, std::size_t triangle) const {
    const auto& [a, b, c] = mesh.triangles[triangle];
    TriangleSetup t;
    t.maps = &maps_[mesh.material];
    const Vec3d p = to_double(mesh.positions[a]);
    const Vec3d twice = cross(to_double(mesh.positions[b]) - p, to_double(mesh.positions[c]) - p);
    t.normal = normalize(twice);
    t.face_normal = to_float(t.normal);
    if (!mesh.normals.empty()) {
        t.normals = {mesh.normals[a], mesh.normals[b], mesh.normals[c]};
        t.smooth = true;
    }
    t.displaced = is_displaced(mesh);
    if (!t.displaced && t.maps->material->alpha_mode == AlphaMode::Opaque) t.run = run_;
    if (!mesh.uvs.empty()) {
        t.uv = {mesh.uvs[a], mesh.uvs[b], mesh.uvs[c]};
        set_texture(t, 0.5 * length(twice));
    }
    const bool framed = t.maps->anisotropic || (t.textured && t.maps->normal != nullptr);
    if (framed) set_tangents(t, mesh, triangle);
    t.constant = is_constant(mesh);
    return t;
}

void SurfaceSampler::set_texture(TriangleSetup& t, double area) const {
    const SurfaceMaps& m = *t.maps;
    t.textured = m.albedo != nullptr || m.normal != nullptr || m.metal_rough != nullptr ||
                 m.anisotropy != nullptr;
    if (!t.textured || !(area > 0.0)) return;
    const double ratio = uv_area(t.uv[0], t.uv[1], t.uv[2]) / area;
    t.footprint_uv =
        static_cast<float>(std::sqrt(ratio * hit_area(t.normal, subvoxel_size_) * t.run));
    const auto level = [&](const FilteredTexture* map) {
        return map != nullptr ? map->level_of(t.footprint_uv) : 0.0f;
    };
    t.albedo_level = level(m.albedo);
    t.metal_rough_level = level(m.metal_rough);
    t.anisotropy_level = level(m.anisotropy);
}

void SurfaceSampler::set_tangents(TriangleSetup& t, const Mesh& mesh, std::size_t triangle) const {
    const auto& corner = mesh.triangles[triangle];
    if (!mesh.tangents.empty()) {
        for (std::size_t n = 0; n < 3; ++n) {
            const Tangent& v = mesh.tangents[corner[n]];
            t.tangents[n] = {v.x, v.y, v.z};
        }
        t.handedness = mesh.tangents[corner[0]].w < 0.0f ? -1.0f : 1.0f;
        return;
    }
    // Without vertex tangents: the direction in which u grows on the triangle.
    const Vec3f d1 = mesh.positions[corner[1]] - mesh.positions[corner[0]];
    const Vec3f d2 = mesh.positions[corner[2]] - mesh.positions[corner[0]];
    const float u1 = t.uv[1].u - t.uv[0].u, v1 = t.uv[1].v - t.uv[0].v;
    const float u2 = t.uv[2].u - t.uv[0].u, v2 = t.uv[2].v - t.uv[0].v;
    const float sign = u1 * v2 - u2 * v1 < 0.0f ? -1.0f : 1.0f;
    const Vec3f along = normalize((d1 * v2 - d2 * v1) * sign, any_perpendicular(t.face_normal));
    t.tangents = {along, along, along};
    t.handedness = sign;
}

bool SurfaceSampler::covers(const SurfaceHit& hit, float alpha) const {
    if (alpha >= 1.0f) return true;
    if (alpha <= 0.0f) return false;
    return alpha > to_unit_float(hash_of(hit, seed_, 0));
}

Uv SurfaceSampler::point_in_footprint(const TriangleSetup& t,
                                      const SurfaceHit& hit,
                                      Uv uv,
                                      float texels_per_uv) const {
    // The bilinear read spans a texel itself: only the rest of the footprint is drawn from.
    const float spread = t.footprint_uv - 1.0f / texels_per_uv;
    if (!(spread > 0.0f)) return uv;
    const std::uint64_t h = hash_of(hit, seed_, 1);
    return {uv.u + spread * (to_unit_float(h) - 0.5f),
            uv.v + spread * (to_unit_float(h << 24) - 0.5f)};
}

SurfaceSample SurfaceSampler::sample(const TriangleSetup& t, const SurfaceHit& hit) const {
    if (!t.smooth) return shade(t, hit, t.face_normal, true);
    return shade(t, hit, normalize(interpolate(t.normals, hit), t.face_normal), true);
}

SurfaceSample
SurfaceSampler::sample(const TriangleSetup& t, const SurfaceHit& hit, Vec3f micro_normal) const {
    return shade(t, hit, micro_normal, false);
}

SurfaceSample SurfaceSampler::shade(const TriangleSetup& t,
                                    const SurfaceHit& hit,
                                    Vec3f normal,
                                    bool mapped_normal) const {
    const SurfaceMaps& m = *t.maps;
    SurfaceSample s;
    s.normal = normal;
    Uv uv;
    if (t.textured)
        uv = {t.uv[0].u * hit.b0 + t.uv[1].u * hit.b1 + t.uv[2].u * hit.b2,
              t.uv[0].v * hit.b0 + t.uv[1].v * hit.b1 + t.uv[2].v * hit.b2};
    Rgba colour;
    const bool mapped = t.textured && m.albedo != nullptr;
    if (mapped) colour = m.albedo->filtered(uv, t.albedo_level);
    s.albedo = {colour.r, colour.g, colour.b};
    const Material& material = *m.material;
    if (material.alpha_mode == AlphaMode::Blend) s.covered = covers(hit, colour.a * material.alpha);
    if (material.alpha_mode == AlphaMode::Mask)
        s.covered = mapped ? covers(hit, colour.a) : material.alpha >= material.alpha_cutoff;
    if (!s.covered) return s;
    if (t.textured && m.metal_rough != nullptr) {
        const Rgba value = m.metal_rough->filtered(uv, t.metal_rough_level);
        s.roughness = value.g;
        s.metalness = value.b;
    }
    if (m.anisotropic || (mapped_normal && t.textured && m.normal != nullptr))
        set_frame(t, hit, uv, mapped_normal, s);
    return s;
}

void SurfaceSampler::set_frame(const TriangleSetup& t,
                               const SurfaceHit& hit,
                               Uv uv,
                               bool mapped_normal,
                               SurfaceSample& s) const {
    const SurfaceMaps& m = *t.maps;
    const Vec3f n = s.normal;
    const Vec3f along = interpolate(t.tangents, hit);
    const Vec3f tangent = normalize(along - n * dot(n, along), any_perpendicular(n));
    const Vec3f bitangent = cross(n, tangent) * t.handedness;
    if (mapped_normal && t.textured && m.normal != nullptr) {
        const Rgba v =
            m.normal->at_point(point_in_footprint(t, hit, uv, m.normal->texels_per_uv()));
        const float scale = m.material->normal_scale;
        s.normal =
            normalize(tangent * ((2.0f * v.r - 1.0f) * scale) +
                          bitangent * ((2.0f * v.g - 1.0f) * scale) + n * (2.0f * v.b - 1.0f),
                      n);
    }
    if (!m.anisotropic) return;
    float x = 1.0f, y = 0.0f;
    if (t.textured && m.anisotropy != nullptr) {
        s.anisotropy = m.anisotropy->filtered(uv, t.anisotropy_level).b;
        const Rgba v =
            m.anisotropy->at_point(point_in_footprint(t, hit, uv, m.anisotropy->texels_per_uv()));
        x = 2.0f * v.r - 1.0f;
        y = 2.0f * v.g - 1.0f;
    }
    const Vec3f direction = tangent * (x * m.rotation_cos - y * m.rotation_sin) +
                            bitangent * (x * m.rotation_sin + y * m.rotation_cos);
    s.tangent =
        normalize(direction - s.normal * dot(s.normal, direction), any_perpendicular(s.normal));
}

std::int64_t SurfaceSampler::bytes() const {
    std::int64_t sum = 0;
    for (const Stored& s : stored_) sum += s.filtered->bytes();
    return sum;
}

std::int64_t SurfaceSampler::predict_bytes(const Geometry& geometry) {
    std::int64_t sum = 0;
    for (const Material& m : geometry.materials)
        for (const std::int32_t map :
             {m.albedo_map, m.metal_rough_map, m.anisotropy_map, m.height_map})
            if (map >= 0 && static_cast<std::size_t>(map) < geometry.textures.size()) {
                const Texture& t = geometry.textures[static_cast<std::size_t>(map)];
                sum += FilteredTexture::predict_bytes(t.width, t.height);
            }
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

} // namespace heddle
