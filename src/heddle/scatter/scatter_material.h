#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/material.h>
#include <heddle/scatter/scatterer.h>

namespace heddle {

/// The scattering constants of a geometry's material, without its maps: a fiber becomes a
/// LambertFiber with its albedo, a surface becomes a Surface.
[[nodiscard]] ScatterMaterial scatter_material_of(const Material& material);

/// Absorption of hair by its two pigments, in linear sRGB: (0.419, 0.697, 1.37) per unit of
/// eumelanin (black, brown) plus (0.187, 0.4, 1.05) per unit of pheomelanin (red).
///                                                 [d'Eon 2011, as pbrt-v4's constants fit it]
/// @param eumelanin, pheomelanin  concentrations >= 0; eumelanin: 0.3 blond, 1.3 brown, 8 black
/// @return  per fiber radius
[[nodiscard]] Vec3f absorption_from_melanin(float eumelanin, float pheomelanin);

/// The absorption with which dense hair, after many scatterings, has the colour `color`.
///
/// (ln color / (5.969 - 0.215 n + 2.532 n^2 - 10.73 n^3 + 5.574 n^4 + 0.245 n^5))^2  [Chiang16]
///
/// @param color    linear; clamped to [0.001, 1]
/// @param width_n  the hair's azimuthal roughness, in [0, 1]
/// @return         per fiber radius
[[nodiscard]] Vec3f absorption_from_color(Vec3f color, float width_n);

} // namespace heddle
