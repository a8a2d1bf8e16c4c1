#include <heddle/scatter/surface_albedo.h>

#include <heddle/base/trig.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace heddle::detail {
namespace {

constexpr int kRoughnesses = 8;  ///< nodes even in roughness
constexpr int kAnisotropies = 6; ///< even in anisotropy
constexpr int kHeights = 16;     ///< even in sqrt(cos theta)
constexpr int kAzimuths = 6;     ///< even in |cos phi|
constexpr int kSlice = kHeights * kAzimuths;
using Table = std::array<SpecularAlbedo, kRoughnesses * kAnisotropies * kSlice>;

Table make_table() {
    Table table;
    std::size_t n = 0;
    for (int r = 0; r < kRoughnesses; ++r) {
        for (int a = 0; a < kAnisotropies; ++a) {
            const Alphas alpha = alphas_of(static_cast<float>(r) / (kRoughnesses - 1),
                                           static_cast<float>(a) / (kAnisotropies - 1));
            for (int i = 0; i < kSlice; ++i) {
                const float root = static_cast<float>(i / kAzimuths) / (kHeights - 1);
                const float z = std::max(1e-4f, root * root);
                const float sine = std::sqrt(1.0f - z * z);
                const float c = static_cast<float>(i % kAzimuths) / (kAzimuths - 1);
                const Vec3f wi{sine * c, sine * std::sqrt(1.0f - c * c), z};
                table[n++] = integrate_specular_albedo(alpha, wi, 16);
            }
        }
    }
    return table;
}

/// A place between two nodes.
struct Step {
    int node;
    float f;
};

Step step_of(float x, int count) {
    const float at = std::min(1.0f, std::max(0.0f, x)) * static_cast<float>(count - 1);
    const int node = std::min(count - 2, static_cast<int>(at));
    return {node, at - static_cast<float>(node)};
}

SpecularAlbedo mix(SpecularAlbedo a, SpecularAlbedo b, float f) {
    return {a.all + (b.all - a.all) * f, a.edge + (b.edge - a.edge) * f};
}

} // namespace

Alphas alphas_of(float roughness, float anisotropy) {
    const float r = std::min(1.0f, std::max(0.0f, roughness));
    const float a = std::min(1.0f, std::max(0.0f, anisotropy));
    const float across = std::max(kMinAlpha, r * r);
    return {across + (1.0f - across) * a * a, across};
}

Vec3f sample_visible_normal(Alphas alpha, Vec3f wi, float u, float t) {
    // stretched until the normals are those of a half sphere; its mirror images of wi fill a cap
    const Vec3f i = normalize(Vec3f{wi.x * alpha.along, wi.y * alpha.across, wi.z});
    const SinCos turn = sincos_turns(static_cast<double>(u));
    const float z = (1.0f - t) * (1.0f + i.z) - i.z;
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    const Vec3f h{r * turn.cos + i.x, r * turn.sin + i.y, z + i.z};
    return normalize(Vec3f{h.x * alpha.along, h.y * alpha.across, std::max(1e-7f, h.z)});
}

SpecularAlbedo integrate_specular_albedo(Alphas alpha, Vec3f wi, int steps) {
    const auto stretched = [alpha](Vec3f w) {
        return length(Vec3f{w.x * alpha.along, w.y * alpha.across, w.z});
    };
    const float in = stretched(wi);
    const float step = 1.0f / static_cast<float>(steps);
    SpecularAlbedo sum{};
    for (int i = 0; i < steps * steps; ++i) {
        const float u = (static_cast<float>(i % steps) + 0.5f) * step;
        const float t = (static_cast<float>(i / steps) + 0.5f) * step;
        const Vec3f h = sample_visible_normal(alpha, wi, u, t);
        const float c = dot(wi, h);
        const Vec3f wo = h * (2.0f * c) - wi;
        if (!(wo.z > 0.0f)) continue;
        // G2 / G1, height-correlated
        const float shown = wo.z * (wi.z + in) / (wo.z * in + wi.z * stretched(wo));
        const float rest = 1.0f - c;
        sum.all += shown;
        sum.edge += shown * (rest * rest) * (rest * rest) * rest;
    }
    return {sum.all * step * step, sum.edge * step * step};
}

SpecularAlbedo specular_albedo(float roughness, float anisotropy, Vec3f wi) {
    static const Table table = make_table();
    const Step r = step_of(roughness, kRoughnesses);
    const Step a = step_of(anisotropy, kAnisotropies);
    const Step z = step_of(std::sqrt(std::max(0.0f, wi.z)), kHeights);
    const float across = std::sqrt(wi.x * wi.x + wi.y * wi.y);
    const Step phi = step_of(across > 0.0f ? std::fabs(wi.x) / across : 1.0f, kAzimuths);

    const SpecularAlbedo* const first = table.data() + z.node * kAzimuths + phi.node;
    const auto slice = [&](int roughness_node, int anisotropy_node) {
        const SpecularAlbedo* p =
            first + (roughness_node * kAnisotropies + anisotropy_node) * kSlice;
        return mix(mix(p[0], p[1], phi.f), mix(p[kAzimuths], p[kAzimuths + 1], phi.f), z.f);
    };
    const auto along_roughness = [&](int anisotropy_node) {
        return mix(slice(r.node, anisotropy_node), slice(r.node + 1, anisotropy_node), r.f);
    };
    if (anisotropy <= 0.0f) return along_roughness(0);
    return mix(along_roughness(a.node), along_roughness(a.node + 1), a.f);
}

} // namespace heddle::detail
