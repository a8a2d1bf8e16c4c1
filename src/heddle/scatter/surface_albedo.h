#pragma once

#include <heddle/base/vec.h>

namespace heddle::detail {

/// The smallest alpha: below it, floats do not resolve the half vector.
inline constexpr float kMinAlpha = 1e-3f;

/// The widths of the distribution of normals along a surface's tangent and across it.
struct Alphas {
    float along, across;
};

/// alpha = roughness^2; mix(alpha, 1, anisotropy^2) along the tangent   [KHR_materials_anisotropy]
[[nodiscard]] Alphas alphas_of(float roughness, float anisotropy);

/// Draws a normal of a GGX surface that is visible from `wi`.            [Heitz 2018; Dupuy 2023]
/// @param wi    unit, z > 0, in the surface's frame
/// @param u, t  uniform in [0, 1)
[[nodiscard]] Vec3f sample_visible_normal(Alphas alpha, Vec3f wi, float u, float t);

/// The share of light that GGX mirrors send out after one reflection.
struct SpecularAlbedo {
    float all;  ///< if each mirror reflects all light
    float edge; ///< if each reflects (1 - cos)^5: Schlick's rise towards grazing angles
};

/// Reads the share from tables of 24 x 32 nodes (without anisotropy) and 12 x 8 x 24 x 6 nodes;
/// each is made at first use: once, thread-safe, in about 25 and 160 ms. Errors: docs/scatter.md.
/// @param wi  unit, z > 0, in the surface's frame
[[nodiscard]] SpecularAlbedo specular_albedo(float roughness, float anisotropy, Vec3f wi);

/// The same by a sum over visible normals: the tables are made with it.
/// @param count  number of normals
[[nodiscard]] SpecularAlbedo integrate_specular_albedo(Alphas alpha, Vec3f wi, int count);

} // namespace heddle::detail
