#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/random.h>
#include <heddle/base/vec.h>
#include <heddle/surface/surface_frame.h>
#include <heddle/surface/surface_view.h>

#include <cmath>
#include <cstdint>

namespace heddle {

// Directions and map values of surface hits.
//
// Colour, roughness, metalness and strength are means over the footprint of a hit (trilinear, in
// linear light; colour is weighted by alpha). Directions are not averaged: a mean normal would lose
// the spread that the voxel's second moment must have. So if the footprint exceeds a texel, normal
// maps and anisotropy directions are read at a random point of it, at the finest level.
// Alpha: the column is covered if the covered fraction of the footprint (for a mask, exactly 0 or 1
// below a texel) exceeds a hash of the hit's position. The mean is right for any footprint.
// Random numbers are hashes of (seed, i, j, k, axis). Only float + - * / sqrt are used: the bits
// are the same everywhere.

/// A hit of `scan_triangle`, to be shaded.
struct SurfaceHit {
    std::int32_t axis = 0;
    std::int32_t i = 0, j = 0, k = 0; ///< global subvoxel index
    float b0 = 1.0f, b1 = 0.0f, b2 = 0.0f;
};

/// The surface at one hit. The values of maps are multipliers, 1 without a map.
struct SurfaceSample {
    bool covered = true;   ///< false: cut away by alpha, and nothing else is set
    Vec3f normal{};        ///< unit, world axes; its sign has no meaning
    Vec3f tangent{};       ///< unit, perpendicular to `normal`; (0, 0, 0) if isotropic
    Vec3f albedo{1, 1, 1}; ///< linear, in [0, 1]
    float roughness = 1.0f;
    float metalness = 1.0f;
    float anisotropy = 1.0f;
};

/// The constants of the hits of one triangle.
struct TriangleSetup {
    const SurfaceMaps* maps = nullptr;
    Vec3f face_normal{};   ///< unit, counter-clockwise side
    Vec3d normal{};        ///< the same in double, for hit_weight()
    bool smooth = false;   ///< vertex normals vary
    bool textured = false; ///< `uv` is valid
    /// number of neighbouring hits of a row that share one sample at their middle
    std::int32_t run = 1;
    Corners<Vec3f> normals{};
    Corners<Vec3f> tangents{};
    float handedness = 1.0f; ///< bitangent = handedness x cross(normal, tangent)
    Corners<Uv> uv{};
    float footprint_uv = 0.0f; ///< square root of the uv area of a sample
    float albedo_level = 0.0f;
    float metal_rough_level = 0.0f;
    float anisotropy_level = 0.0f;
};

namespace surface_detail {

HEDDLE_HD inline double uv_area(Uv a, Uv b, Uv c) {
    const double u1 = double{b.u} - double{a.u}, v1 = double{b.v} - double{a.v};
    const double u2 = double{c.u} - double{a.u}, v2 = double{c.v} - double{a.v};
    return 0.5 * std::abs(u1 * v2 - u2 * v1);
}

// Returns the mean area of the surface per hit: the columns' sections projected onto the surface,
// weighted by the share of the area that each axis has.
HEDDLE_HD inline double hit_area(Vec3d n, Vec3d s) {
    return n.x * n.x * s.y * s.z + n.y * n.y * s.z * s.x + n.z * n.z * s.x * s.y;
}

HEDDLE_HD inline float level_of(const TextureView* map, float footprint_uv) {
    return map != nullptr ? map->level_of(footprint_uv) : 0.0f;
}

HEDDLE_HD inline void set_texture(const SurfaceView& view, double area, TriangleSetup& t) {
    const SurfaceMaps& m = *t.maps;
    t.textured = m.albedo != nullptr || m.normal != nullptr || m.metal_rough != nullptr ||
                 m.anisotropy != nullptr;
    if (!t.textured || !(area > 0.0)) return;
    const double ratio = uv_area(t.uv[0], t.uv[1], t.uv[2]) / area;
    t.footprint_uv =
        static_cast<float>(std::sqrt(ratio * hit_area(t.normal, view.subvoxel_size) * t.run));
    t.albedo_level = level_of(m.albedo, t.footprint_uv);
    t.metal_rough_level = level_of(m.metal_rough, t.footprint_uv);
    t.anisotropy_level = level_of(m.anisotropy, t.footprint_uv);
}

HEDDLE_HD inline void set_tangents(const MeshView& mesh, std::uint64_t triangle, TriangleSetup& t) {
    if (mesh.tangents != nullptr) {
        const CornerTangents given = corner_tangents(mesh, triangle);
        t.tangents = given.direction;
        t.handedness = given.handedness;
        return;
    }
    const SurfaceDirection along = direction_of_u(mesh, triangle, t.uv, t.face_normal);
    t.tangents = {along.direction, along.direction, along.direction};
    t.handedness = along.handedness;
}

HEDDLE_HD inline std::uint64_t
hash_of(const SurfaceHit& h, std::uint64_t seed, std::uint64_t draw) {
    const auto word = [](std::int32_t i) { return std::uint64_t{static_cast<std::uint32_t>(i)}; };
    const std::uint64_t salt = 4 * draw + static_cast<std::uint64_t>(h.axis);
    return hash64(seed ^ (salt << 40), word(h.i) << 32 | word(h.j), word(h.k));
}

HEDDLE_HD inline bool covers(std::uint64_t seed, const SurfaceHit& hit, float alpha) {
    if (alpha >= 1.0f) return true;
    if (alpha <= 0.0f) return false;
    return alpha > to_unit_float(hash_of(hit, seed, 0));
}

HEDDLE_HD inline Uv point_in_footprint(
    std::uint64_t seed, const TriangleSetup& t, const SurfaceHit& hit, Uv uv, float texels_per_uv) {
    // The bilinear filter already spans a texel: the point is random in the rest of the footprint.
    const float spread = t.footprint_uv - 1.0f / texels_per_uv;
    if (!(spread > 0.0f)) return uv;
    const std::uint64_t h = hash_of(hit, seed, 1);
    return {uv.u + spread * (to_unit_float(h) - 0.5f),
            uv.v + spread * (to_unit_float(h << 24) - 0.5f)};
}

/// Sets the normal, by the normal map if `mapped_normal`, and the tangent of anisotropic materials.
HEDDLE_HD inline void set_frame(std::uint64_t seed,
                                const TriangleSetup& t,
                                const SurfaceHit& hit,
                                Uv uv,
                                bool mapped_normal,
                                SurfaceSample& s) {
    const SurfaceMaps& m = *t.maps;
    const SurfaceFrame f =
        frame_of(s.normal, {interpolate(t.tangents, hit.b0, hit.b1, hit.b2), t.handedness});
    if (mapped_normal && t.textured && m.normal != nullptr) {
        const Uv point = point_in_footprint(seed, t, hit, uv, m.normal->texels_per_uv);
        s.normal = normal_from_map(f, m, m.normal->at_point(point));
    }
    if (!m.anisotropic) return;
    FrameDirection d;
    if (t.textured && m.anisotropy != nullptr) {
        s.anisotropy = m.anisotropy->filtered(uv, t.anisotropy_level).b;
        d = direction_in_frame(m.anisotropy->at_point(
            point_in_footprint(seed, t, hit, uv, m.anisotropy->texels_per_uv)));
    }
    const Vec3f direction = turned_direction(f, m, d.x, d.y);
    s.tangent =
        normalize(direction - s.normal * dot(s.normal, direction), any_perpendicular(s.normal));
}

HEDDLE_HD inline SurfaceSample shade(std::uint64_t seed,
                                     const TriangleSetup& t,
                                     const SurfaceHit& hit,
                                     Vec3f normal,
                                     bool mapped_normal) {
    const SurfaceMaps& m = *t.maps;
    SurfaceSample s;
    s.normal = normal;
    Uv uv;
    if (t.textured) uv = interpolate(t.uv, hit.b0, hit.b1, hit.b2);
    Rgba colour;
    const bool mapped = t.textured && m.albedo != nullptr;
    if (mapped) colour = m.albedo->filtered(uv, t.albedo_level);
    s.albedo = {colour.r, colour.g, colour.b};
    s.covered = covers(seed, hit, coverage_of(m, mapped, colour.a));
    if (!s.covered) return s;
    if (t.textured && m.metal_rough != nullptr) {
        const Rgba value = m.metal_rough->filtered(uv, t.metal_rough_level);
        s.roughness = value.g;
        s.metalness = value.b;
    }
    if (m.anisotropic || (mapped_normal && t.textured && m.normal != nullptr))
        set_frame(seed, t, hit, uv, mapped_normal, s);
    return s;
}

} // namespace surface_detail

/// Returns the constants of the hits of a triangle.
/// @param triangle  number in the mesh
[[nodiscard]] HEDDLE_HD inline TriangleSetup
set_up_triangle(const SurfaceView& view, const MeshView& mesh, std::uint64_t triangle) {
    const Corners<std::uint32_t> corner = mesh.triangles[triangle];
    const std::uint32_t a = corner[0], b = corner[1], c = corner[2];
    TriangleSetup t;
    t.maps = &view.materials[mesh.material];
    const Vec3d twice = doubled_area(mesh, triangle);
    t.normal = normalize(twice);
    t.face_normal = to_float(t.normal);
    if (mesh.normals != nullptr) {
        t.normals = {mesh.normals[a], mesh.normals[b], mesh.normals[c]};
        t.smooth = true;
    }
    const bool displaced = mesh.kind == SurfaceKind::Displaced;
    if (!displaced && t.maps->alpha_mode == AlphaMode::Opaque) t.run = view.run;
    if (mesh.uvs != nullptr) {
        t.uv = {mesh.uvs[a], mesh.uvs[b], mesh.uvs[c]};
        surface_detail::set_texture(view, 0.5 * length(twice), t);
    }
    const bool framed = t.maps->anisotropic || (t.textured && t.maps->normal != nullptr);
    if (framed) surface_detail::set_tangents(mesh, triangle, t);
    return t;
}

/// Returns the surface at a hit.
/// @param seed  SurfaceView::seed
[[nodiscard]] HEDDLE_HD inline SurfaceSample
sample_at(std::uint64_t seed, const TriangleSetup& t, const SurfaceHit& hit) {
    using namespace surface_detail;
    const Vec3f normal =
        t.smooth ? normalize(interpolate(t.normals, hit.b0, hit.b1, hit.b2), t.face_normal)
                 : t.face_normal;
    return shade(seed, t, hit, normal, true);
}

/// Returns the surface at a hit of a displaced triangle. `micro_normal` (unit) replaces the
/// interpolated normal and the normal map, which contains the same relief.
[[nodiscard]] HEDDLE_HD inline SurfaceSample
sample_at(std::uint64_t seed, const TriangleSetup& t, const SurfaceHit& hit, Vec3f micro_normal) {
    return surface_detail::shade(seed, t, hit, micro_normal, false);
}

} // namespace heddle
