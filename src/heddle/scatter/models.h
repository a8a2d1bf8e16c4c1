#pragma once

#include <heddle/scatter/scatterer.h>

namespace heddle::detail {

/// A direction and the model's value for it.
struct ScatterDraw {
    Vec3f direction;
    ScatterValue value;
};

// Two functions for each family: one evaluates, one draws a direction. Arguments as in scatterer.h.
// Defined in microflake.cpp, lambert_fiber.cpp, lobe_fiber.cpp, hair.cpp, surface.cpp

[[nodiscard]] ScatterValue specular_flake_value(const Scatterer& at, Vec3f wi, Vec3f wo);
[[nodiscard]] ScatterDraw draw_specular_flake(const Scatterer& at, Vec3f wi, Vec3f u);

[[nodiscard]] ScatterValue diffuse_flake_value(const Scatterer& at, Vec3f wi, Vec3f wo);
[[nodiscard]] ScatterDraw draw_diffuse_flake(const Scatterer& at, Vec3f wi, Vec3f u);

[[nodiscard]] ScatterValue lambert_fiber_value(const Scatterer& at, Vec3f wi, Vec3f wo);
[[nodiscard]] ScatterDraw draw_lambert_fiber(const Scatterer& at, Vec3f wi, Vec3f u);

[[nodiscard]] ScatterValue lobe_fiber_value(const Scatterer& at, Vec3f wi, Vec3f wo);
[[nodiscard]] ScatterDraw draw_lobe_fiber(const Scatterer& at, Vec3f wi, Vec3f u);

[[nodiscard]] ScatterValue hair_value(const Scatterer& at, Vec3f wi, Vec3f wo);
[[nodiscard]] ScatterDraw draw_hair(const Scatterer& at, Vec3f wi, Vec3f u);

[[nodiscard]] ScatterValue surface_value(const Scatterer& at, Vec3f wi, Vec3f wo);
[[nodiscard]] ScatterDraw draw_surface(const Scatterer& at, Vec3f wi, Vec3f u);

} // namespace heddle::detail
