#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>
#include <heddle/surface/surface_view.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

// What a triangle with a material's maps is at one point: one body for the voxelizer's hits and for
// the points that rays hit. float + - * / sqrt only: the same everywhere.

namespace heddle {

/// A value at each corner of a triangle.
template <typename T>
using Corners = std::array<T, 3>;

/// @param b0, b1, b2  barycentric, their sum is 1
[[nodiscard]] HEDDLE_HD inline Vec3f
interpolate(const Corners<Vec3f>& v, float b0, float b1, float b2) {
    return v[0] * b0 + v[1] * b1 + v[2] * b2;
}
[[nodiscard]] HEDDLE_HD inline Uv interpolate(const Corners<Uv>& v, float b0, float b1, float b2) {
    return {v[0].u * b0 + v[1].u * b1 + v[2].u * b2, v[0].v * b0 + v[1].v * b1 + v[2].v * b2};
}

/// Twice a triangle's area times its normal, which shows to the counter-clockwise side.
[[nodiscard]] HEDDLE_HD inline Vec3d doubled_area(const MeshView& mesh, std::uint64_t triangle) {
    const Corners<std::uint32_t> corner = mesh.triangles[triangle];
    const Vec3d p = to_double(mesh.positions[corner[0]]);
    return cross(to_double(mesh.positions[corner[1]]) - p,
                 to_double(mesh.positions[corner[2]]) - p);
}

/// The covered fraction that a material's alpha tells.
/// @param mapped  the material's albedo map is read
/// @param alpha   of that map; of a mask the covered fraction; 1 without a map
[[nodiscard]] HEDDLE_HD inline float coverage_of(const SurfaceMaps& m, bool mapped, float alpha) {
    if (m.alpha_mode == AlphaMode::Opaque) return 1.0f;
    if (m.alpha_mode == AlphaMode::Blend) return alpha * m.alpha;
    if (mapped) return alpha;
    return m.alpha >= m.alpha_cutoff ? 1.0f : 0.0f;
}

/// A direction along the surface with the sign of the bitangent.
struct SurfaceDirection {
    Vec3f direction;
    float handedness = 1.0f; ///< bitangent = handedness x cross(normal, tangent)
};

/// The direction in which u grows on a triangle; any one where uv is constant.
[[nodiscard]] HEDDLE_HD inline SurfaceDirection direction_of_u(const MeshView& mesh,
                                                               std::uint64_t triangle,
                                                               const Corners<Uv>& uv,
                                                               Vec3f face_normal) {
    const Corners<std::uint32_t> corner = mesh.triangles[triangle];
    const Vec3f d1 = mesh.positions[corner[1]] - mesh.positions[corner[0]];
    const Vec3f d2 = mesh.positions[corner[2]] - mesh.positions[corner[0]];
    const float u1 = uv[1].u - uv[0].u, v1 = uv[1].v - uv[0].v;
    const float u2 = uv[2].u - uv[0].u, v2 = uv[2].v - uv[0].v;
    const float sign = u1 * v2 - u2 * v1 < 0.0f ? -1.0f : 1.0f;
    return {normalize((d1 * v2 - d2 * v1) * sign, any_perpendicular(face_normal)), sign};
}

/// The vertex tangents of a triangle, whose bitangents have the sign of its first corner's.
struct CornerTangents {
    Corners<Vec3f> direction;
    float handedness = 1.0f;
};

/// @param mesh  one that has tangents
[[nodiscard]] HEDDLE_HD inline CornerTangents corner_tangents(const MeshView& mesh,
                                                              std::uint64_t triangle) {
    const Corners<std::uint32_t> corner = mesh.triangles[triangle];
    CornerTangents out;
    for (std::size_t n = 0; n < 3; ++n) {
        const Tangent& v = mesh.tangents[corner[n]];
        out.direction[n] = {v.x, v.y, v.z};
    }
    out.handedness = mesh.tangents[corner[0]].w < 0.0f ? -1.0f : 1.0f;
    return out;
}

/// The axes that normal maps and anisotropy directions count in; unit.
struct SurfaceFrame {
    Vec3f normal, tangent, bitangent;
};

/// @param normal  unit
[[nodiscard]] HEDDLE_HD inline SurfaceFrame frame_of(Vec3f normal, const SurfaceDirection& along) {
    const Vec3f flat = along.direction - normal * dot(normal, along.direction);
    const Vec3f tangent = normalize(flat, any_perpendicular(normal));
    return {normal, tangent, cross(normal, tangent) * along.handedness};
}

/// The normal that a normal map's value says; unit.
[[nodiscard]] HEDDLE_HD inline Vec3f
normal_from_map(const SurfaceFrame& f, const SurfaceMaps& maps, Rgba value) {
    const float scale = maps.normal_scale;
    return normalize(f.tangent * ((2.0f * value.r - 1.0f) * scale) +
                         f.bitangent * ((2.0f * value.g - 1.0f) * scale) +
                         f.normal * (2.0f * value.b - 1.0f),
                     f.normal);
}

/// The direction of anisotropy: (x, y) in the frame, turned by the material's rotation. Not unit.
[[nodiscard]] HEDDLE_HD inline Vec3f
turned_direction(const SurfaceFrame& f, const SurfaceMaps& maps, float x, float y) {
    return f.tangent * (x * maps.rotation_cos - y * maps.rotation_sin) +
           f.bitangent * (x * maps.rotation_sin + y * maps.rotation_cos);
}

/// (x, y) of an anisotropy map's value.
struct FrameDirection {
    float x = 1.0f, y = 0.0f;
};
[[nodiscard]] HEDDLE_HD inline FrameDirection direction_in_frame(Rgba value) {
    return {2.0f * value.r - 1.0f, 2.0f * value.g - 1.0f};
}

} // namespace heddle
