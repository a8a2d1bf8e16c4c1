#include <heddle/scatter/scatterer.h>

#include <heddle/scatter/models.h>

#include <algorithm>
#include <cmath>

namespace heddle {
namespace {

detail::ScatterDraw draw(const Scatterer& at, Vec3f wi, Vec3f u) {
    switch (at.material.model) {
    case ScatterModel::MicroflakeSpecular: return detail::draw_specular_flake(at, wi, u);
    case ScatterModel::MicroflakeDiffuse: return detail::draw_diffuse_flake(at, wi, u);
    case ScatterModel::LambertFiber: return detail::draw_lambert_fiber(at, wi, u);
    case ScatterModel::LobeFiber: return detail::draw_lobe_fiber(at, wi, u);
    case ScatterModel::Hair: return detail::draw_hair(at, wi, u);
    case ScatterModel::Surface: return detail::draw_surface(at, wi, u);
    }
    return {};
}

} // namespace

ScatterValue evaluate_with_pdf(const Scatterer& at, Vec3f wi, Vec3f wo) {
    switch (at.material.model) {
    case ScatterModel::MicroflakeSpecular: return detail::specular_flake_value(at, wi, wo);
    case ScatterModel::MicroflakeDiffuse: return detail::diffuse_flake_value(at, wi, wo);
    case ScatterModel::LambertFiber: return detail::lambert_fiber_value(at, wi, wo);
    case ScatterModel::LobeFiber: return detail::lobe_fiber_value(at, wi, wo);
    case ScatterModel::Hair: return detail::hair_value(at, wi, wo);
    case ScatterModel::Surface: return detail::surface_value(at, wi, wo);
    }
    return {};
}

Vec3f evaluate(const Scatterer& at, Vec3f wi, Vec3f wo) {
    return evaluate_with_pdf(at, wi, wo).value;
}

float pdf(const Scatterer& at, Vec3f wi, Vec3f wo) {
    return evaluate_with_pdf(at, wi, wo).pdf;
}

ScatterSample sample(const Scatterer& at, Vec3f wi, Vec3f u) {
    const detail::ScatterDraw d = draw(at, wi, u);
    ScatterSample s;
    s.direction = d.direction;
    constexpr float kMinPdf = 1e-30f; // 1 / pdf is still finite
    if (!(d.value.pdf > kMinPdf)) return s;
    s.pdf = d.value.pdf;
    s.weight = d.value.value * (1.0f / s.pdf);
    s.roughness = std::min(1.0f, 0.56418958f / std::sqrt(s.pdf)); // 1 / sqrt(pi)
    return s;
}

} // namespace heddle
