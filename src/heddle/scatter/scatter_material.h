#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/material.h>
#include <heddle/scatter/scatterer.h>

namespace heddle {

/// The scattering constants of a geometry's material, maps not applied: a fiber is LambertFiber of
/// its albedo, a surface is Surface.
[[nodiscard]] ScatterMaterial scatter_material_of(const Material& material);

/// Absorption of hair by the two pigments, in linear sRGB: the sum of (.419, .697, 1.37) a unit of
/// eumelanin (black, brown) and (.187, .4, 1.05) a unit of pheomelanin (red).
///                                                 [d'Eon 2011, as pbrt-v4's constants fit it]
/// @param eumelanin, pheomelanin  concentrations >= 0: blond .3, brown 1.3, black 8 of eumelanin
/// @return  per fiber radius
[[nodiscard]] Vec3f absorption_from_melanin(float eumelanin, float pheomelanin);

/// Absorption with which much hair, light scattered many times in it, looks like `color`.
///
/// (ln color / (5.969 - .215 n + 2.532 n^2 - 10.73 n^3 + 5.574 n^4 + .245 n^5))^2  [Chiang16]
///
/// @param color    linear; clamped to [.001, 1]
/// @param width_n  the hair's azimuthal roughness, in [0, 1]
/// @return         per fiber radius
[[nodiscard]] Vec3f absorption_from_color(Vec3f color, float width_n);

} // namespace heddle
