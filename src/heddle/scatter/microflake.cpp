#include <heddle/scatter/approximate.h>
#include <heddle/scatter/draw.h>
#include <heddle/scatter/models.h>
#include <heddle/sggx/sample.h>

#include <cmath>
#include <cstdint>

namespace heddle::detail {
namespace {

/// Two given uniform numbers, as the bits that the samplers of sggx read.
struct GivenBits {
    float a, b;

    [[nodiscard]] std::uint64_t next() const {
        const auto bits = [](float x) { return static_cast<std::uint64_t>(x * 0x1p24f); };
        return bits(a) << 40 | bits(b) << 16;
    }
};

} // namespace

ScatterValue specular_flake_value(const Scatterer& at, Vec3f wi, Vec3f wo) {
    // opposite directions: any normal across them, which is the limit along one way
    const Vec3f h = normalize(wi + wo, any_perpendicular(wi));
    const float area = projected_area(at.lobe, wi);
    if (!(area > 0.0f)) return {};
    // vndf / (4 wi.h), where wi.h cancels; D covers the whole sphere: half of Heitz's
    const float density = ndf(at.lobe, h) * 0.5f / area;
    return {at.material.albedo * density, density};
}

ScatterDraw draw_specular_flake(const Scatterer& at, Vec3f wi, Vec3f u) {
    GivenBits bits{u.x, u.y};
    const Vec3f h = sample_vndf(factor(at.lobe), wi, bits);
    const Vec3f wo = normalize(h * (2.0f * dot(wi, h)) - wi);
    return {wo, specular_flake_value(at, wi, wo)};
}

ScatterValue diffuse_flake_value(const Scatterer& at, Vec3f, Vec3f wo) {
    const float density = kInversePi * std::max(0.0f, dot(wo, at.axis));
    return {at.material.albedo * density, density};
}

ScatterDraw draw_diffuse_flake(const Scatterer& at, Vec3f wi, Vec3f u) {
    const Vec3f x = any_perpendicular(at.axis);
    const Vec3f wo = to_world(sample_cosine(u.x, u.y), x, cross(at.axis, x), at.axis);
    return {wo, diffuse_flake_value(at, wi, wo)};
}

} // namespace heddle::detail
