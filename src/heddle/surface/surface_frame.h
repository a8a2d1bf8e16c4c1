#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>
#include <heddle/surface/surface_view.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

// The normal, tangent and coverage of a triangle with maps at one point, for the hits of the
// voxelizer and of rays. Only float + - * / sqrt are used: the bits are the same everywhere.

namespace heddle {

/// A value at each corner of a triangle.
template <typename T>
using Corners = std::array<T, 3>;

/// Interpolates over a triangle.
/// @param b0, b1, b2  barycentric coordinates with a sum of 1
[[nodiscard]] HEDDLE_HD inline Vec3f
interpolate(const Corners<Vec3f>& v, float b0, float b1, float b2) {
    return v[0] * b0 + v[1] * b1 + v[2] * b2;
}
[[nodiscard]] HEDDLE_HD inline Uv interpolate(const Corners<Uv>& v, float b0, float b1, float b2) {
    return {v[0].u * b0 + v[1].u * b1 + v[2].u * b2, v[0].v * b0 + v[1].v * b1 + v[2].v * b2};
}

/// Returns twice a triangle's area times its normal, which points to the counter-clockwise side.
[[nodiscard]] HEDDLE_HD inline Vec3d doubled_area(const MeshView& mesh, std::uint64_t triangle) {
    const Corners<std::uint32_t> corner = mesh.triangles[triangle];
    const Vec3d p = to_double(mesh.positions[corner[0]]);
    return cross(to_double(mesh.positions[corner[1]]) - p,
                 to_double(mesh.positions[corner[2]]) - p);
}

/// Returns the covered fraction according to a material's alpha.
/// @param mapped  true: the material's albedo map is read
/// @param alpha   alpha of that map; for a mask the covered fraction; 1 without a map
[[nodiscard]] HEDDLE_HD inline float coverage_of(const SurfaceMaps& m, bool mapped, float alpha) {
    if (m.alpha_mode == AlphaMode::Opaque) return 1.0f;
    if (m.alpha_mode == AlphaMode::Blend) return alpha * m.alpha;
    if (mapped) return alpha;
    return m.alpha >= m.alpha_cutoff ? 1.0f : 0.0f;
}

/// A direction along the surface, with the sign of the bitangent.
struct SurfaceDirection {
    Vec3f direction;
    float handedness = 1.0f; ///< bitangent = handedness x cross(normal, tangent)
};

/// Returns the direction in which u grows on a triangle; any direction if uv is constant.
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

/// The vertex tangents of a triangle, with the bitangent sign of its first corner.
struct CornerTangents {
    Corners<Vec3f> direction;
    float handedness = 1.0f;
};

/// Returns the vertex tangents of a triangle.
/// @param mesh  a mesh with tangents
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

/// The unit axes that normal maps and anisotropy directions refer to.
struct SurfaceFrame {
    Vec3f normal, tangent, bitangent;
};

/// Returns the frame of a unit normal and a direction along the surface.
[[nodiscard]] HEDDLE_HD inline SurfaceFrame frame_of(Vec3f normal, const SurfaceDirection& along) {
    const Vec3f flat = along.direction - normal * dot(normal, along.direction);
    const Vec3f tangent = normalize(flat, any_perpendicular(normal));
    return {normal, tangent, cross(normal, tangent) * along.handedness};
}

/// Returns the unit normal for a value of a normal map.
[[nodiscard]] HEDDLE_HD inline Vec3f
normal_from_map(const SurfaceFrame& f, const SurfaceMaps& maps, Rgba value) {
    const float scale = maps.normal_scale;
    return normalize(f.tangent * ((2.0f * value.r - 1.0f) * scale) +
                         f.bitangent * ((2.0f * value.g - 1.0f) * scale) +
                         f.normal * (2.0f * value.b - 1.0f),
                     f.normal);
}

/// Returns the direction of anisotropy: (x, y) in the frame, turned by the material's rotation. It
/// is not normalized.
[[nodiscard]] HEDDLE_HD inline Vec3f
turned_direction(const SurfaceFrame& f, const SurfaceMaps& maps, float x, float y) {
    return f.tangent * (x * maps.rotation_cos - y * maps.rotation_sin) +
           f.bitangent * (x * maps.rotation_sin + y * maps.rotation_cos);
}

/// The direction (x, y) of a value of an anisotropy map.
struct FrameDirection {
    float x = 1.0f, y = 0.0f;
};
[[nodiscard]] HEDDLE_HD inline FrameDirection direction_in_frame(Rgba value) {
    return {2.0f * value.r - 1.0f, 2.0f * value.g - 1.0f};
}

} // namespace heddle
