#include <heddle/scatter/approximate.h>
#include <heddle/scatter/draw.h>
#include <heddle/scatter/models.h>
#include <heddle/scatter/surface_albedo.h>

#include <algorithm>
#include <cmath>

namespace heddle::detail {
namespace {

constexpr float kDielectric = 0.04f; ///< reflectance at normal incidence, as in glTF: eta = 1.5

float mean(Vec3f c) {
    return (c.x + c.y + c.z) * (1.0f / 3.0f);
}

float mix(float a, float b, float f) {
    return a + (b - a) * f;
}

float clamp01(float x) {
    return std::min(1.0f, std::max(0.0f, x));
}

/// All values that do not depend on wo.
struct SurfaceLobes {
    Vec3f x, y, z;
    Vec3f in;  ///< wi in these axes
    bool seen; ///< true if wi is on the front side
    Alphas alpha{};
    float stretched_in = 0.0f;
    Vec3f normal_reflectance; ///< F0
    float edge_reflectance = 0.0f;
    Vec3f gain;    ///< for multiple scattering between mirrors
    Vec3f diffuse; ///< albedo of the light that is not mirrored
    float choose_specular = 0.0f;

    SurfaceLobes(const Scatterer& at, Vec3f wi)
        : x(at.tangent),
          y(cross(at.axis, at.tangent)),
          z(at.axis),
          in{dot(wi, x), dot(wi, y), dot(wi, z)},
          seen(in.z > 0.0f) {
        if (!seen) return;
        const ScatterMaterial& m = at.material;
        alpha = alphas_of(m.roughness, m.anisotropy);
        stretched_in = stretched(in);
        set_reflectance(m, specular_albedo(m.roughness, m.anisotropy, in));
    }

    [[nodiscard]] float stretched(Vec3f w) const {
        return length(Vec3f{w.x * alpha.along, w.y * alpha.across, w.z});
    }

    /// Light lost by scattering between mirrors is added to the first reflection, with one more
    /// factor F0 for each further reflection: white metal loses nothing.        [Turquin 2019]
    void set_reflectance(const ScatterMaterial& m, SpecularAlbedo share) {
        const float specular = std::max(0.0f, m.specular);
        const float plastic = std::min(1.0f, kDielectric * specular);
        const float plastic_edge = std::min(1.0f, specular);
        const float metal = clamp01(m.metalness);
        edge_reflectance = mix(plastic_edge, 1.0f, metal);
        const float lost = (1.0f - share.all) / share.all;
        const auto total = [&](float f0, float f90) {
            return (f0 * (share.all - share.edge) + f90 * share.edge) * (1.0f + f0 * lost);
        };
        const float below = (1.0f - metal) * (1.0f - std::min(1.0f, total(plastic, plastic_edge)));
        Vec3f mirrored;
        for (int c = 0; c < 3; ++c) {
            const float f0 = mix(plastic, m.albedo[c], metal);
            normal_reflectance[c] = f0;
            gain[c] = 1.0f + f0 * lost;
            mirrored[c] = total(f0, edge_reflectance);
            diffuse[c] = m.albedo[c] * below;
        }
        const float s = mean(mirrored);
        const float d = mean(diffuse);
        choose_specular = s + d > 0.0f ? s / (s + d) : 0.0f;
    }

    [[nodiscard]] ScatterValue value(Vec3f wo) const {
        const Vec3f out{dot(wo, x), dot(wo, y), dot(wo, z)};
        if (!seen || !(out.z > 0.0f)) return {};
        const Vec3f h = normalize(in + out);
        const float hx = h.x / alpha.along;
        const float hy = h.y / alpha.across;
        const float q = hx * hx + hy * hy + h.z * h.z;
        const float D = kInversePi / (alpha.along * alpha.across * q * q);
        const float G = 0.5f / (out.z * stretched_in + in.z * stretched(out)); // G2 / (4 in out)
        const float rest = clamp01(1.0f - dot(in, h));
        const float edge = (rest * rest) * (rest * rest) * rest;
        const float mirrored = D * G * out.z;
        const float lambert = kInversePi * out.z;
        ScatterValue result;
        for (int c = 0; c < 3; ++c) {
            const float F = mix(normal_reflectance[c], edge_reflectance, edge);
            result.value[c] = mirrored * F * gain[c] + diffuse[c] * lambert;
        }
        const float drawn = 0.5f * D / (in.z + stretched_in); // visible normals / (4 in.h)
        result.pdf = mix(lambert, drawn, choose_specular);
        return result;
    }
};

} // namespace

ScatterValue surface_value(const Scatterer& at, Vec3f wi, Vec3f wo) {
    return SurfaceLobes(at, wi).value(wo);
}

ScatterDraw draw_surface(const Scatterer& at, Vec3f wi, Vec3f u) {
    const SurfaceLobes lobes(at, wi);
    if (!lobes.seen) return {at.axis, {}};
    Vec3f local;
    if (u.z < lobes.choose_specular) {
        const Vec3f h = sample_visible_normal(lobes.alpha, lobes.in, u.x, u.y);
        local = h * (2.0f * dot(lobes.in, h)) - lobes.in;
    } else {
        local = sample_cosine(u.x, u.y);
    }
    const Vec3f wo = to_world(local, lobes.x, lobes.y, lobes.z);
    return {wo, lobes.value(wo)};
}

} // namespace heddle::detail
