#include <heddle/scatter/surface_albedo.h>

#include <heddle/base/trig.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace heddle::detail {
namespace {

/// The nodes of a table: evenly spaced in roughness, anisotropy, sqrt(cos theta) and |cos phi|.
struct Nodes {
    int roughness, anisotropy, height, azimuth;

    [[nodiscard]] constexpr int slice() const { return height * azimuth; }
    [[nodiscard]] constexpr std::size_t count() const {
        return static_cast<std::size_t>(roughness * anisotropy * slice());
    }
};
constexpr Nodes kRound{24, 1, 32, 1};
constexpr Nodes kStretched{12, 8, 24, 6};

float fraction(int node, int count) {
    return count > 1 ? static_cast<float>(node) / static_cast<float>(count - 1) : 0.0f;
}

template <Nodes kNodes>
std::array<SpecularAlbedo, kNodes.count()> make_table(int normals) {
    std::array<SpecularAlbedo, kNodes.count()> table;
    std::size_t n = 0;
    for (int r = 0; r < kNodes.roughness; ++r) {
        for (int a = 0; a < kNodes.anisotropy; ++a) {
            const Alphas alpha =
                alphas_of(fraction(r, kNodes.roughness), fraction(a, kNodes.anisotropy));
            for (int i = 0; i < kNodes.slice(); ++i) {
                const float root = fraction(i / kNodes.azimuth, kNodes.height);
                const float z = std::max(1e-4f, root * root);
                const float sine = std::sqrt(1.0f - z * z);
                const float c = fraction(i % kNodes.azimuth, kNodes.azimuth);
                const Vec3f wi{sine * c, sine * std::sqrt(1.0f - c * c), z};
                table[n++] = integrate_specular_albedo(alpha, wi, normals);
            }
        }
    }
    return table;
}

/// A position between two nodes.
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
    // stretched so that the normals become a half sphere; the reflections of wi fill a cap
    const Vec3f i = normalize(Vec3f{wi.x * alpha.along, wi.y * alpha.across, wi.z});
    const SinCos turn = sincos_turns(static_cast<double>(u));
    const float z = (1.0f - t) * (1.0f + i.z) - i.z;
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    const Vec3f h{r * turn.cos + i.x, r * turn.sin + i.y, z + i.z};
    return normalize(Vec3f{h.x * alpha.along, h.y * alpha.across, std::max(1e-7f, h.z)});
}

SpecularAlbedo integrate_specular_albedo(Alphas alpha, Vec3f wi, int count) {
    const auto stretched = [alpha](Vec3f w) {
        return length(Vec3f{w.x * alpha.along, w.y * alpha.across, w.z});
    };
    const float in = stretched(wi);
    constexpr double kGolden = 0.6180339887498949; // turns per point of a Fibonacci lattice
    const float step = 1.0f / static_cast<float>(count);
    SpecularAlbedo sum{};
    for (int i = 0; i < count; ++i) {
        const double turns = kGolden * i;
        const auto u = static_cast<float>(turns - std::floor(turns));
        const float t = (static_cast<float>(i) + 0.5f) * step;
        const Vec3f h = sample_visible_normal(alpha, wi, u, t);
        const float c = dot(wi, h);
        const Vec3f wo = h * (2.0f * c) - wi;
        if (!(wo.z > 0.0f)) continue;
        // height-correlated G2 / G1
        const float shown = wo.z * (wi.z + in) / (wo.z * in + wi.z * stretched(wo));
        const float rest = 1.0f - c;
        sum.all += shown;
        sum.edge += shown * (rest * rest) * (rest * rest) * rest;
    }
    return {sum.all * step, sum.edge * step};
}

namespace {

SpecularAlbedo round_albedo(float roughness, float root_z) {
    static const auto table = make_table<kRound>(610);
    const Step r = step_of(roughness, kRound.roughness);
    const Step z = step_of(root_z, kRound.height);
    const SpecularAlbedo* const p = table.data() + r.node * kRound.height + z.node;
    const SpecularAlbedo* const q = p + kRound.height;
    return mix(mix(p[0], p[1], z.f), mix(q[0], q[1], z.f), r.f);
}

SpecularAlbedo stretched_albedo(float roughness, float anisotropy, float root_z, float cosine) {
    constexpr Nodes kN = kStretched;
    static const auto table = make_table<kStretched>(233);
    const Step r = step_of(roughness, kN.roughness);
    const Step a = step_of(anisotropy, kN.anisotropy);
    const Step z = step_of(root_z, kN.height);
    const Step phi = step_of(cosine, kN.azimuth);
    const SpecularAlbedo* const first = table.data() + z.node * kN.azimuth + phi.node;
    const auto slice = [&](int roughness_node, int anisotropy_node) {
        const SpecularAlbedo* const p =
            first + (roughness_node * kN.anisotropy + anisotropy_node) * kN.slice();
        const SpecularAlbedo* const q = p + kN.azimuth;
        return mix(mix(p[0], p[1], phi.f), mix(q[0], q[1], phi.f), z.f);
    };
    const auto along_roughness = [&](int anisotropy_node) {
        return mix(slice(r.node, anisotropy_node), slice(r.node + 1, anisotropy_node), r.f);
    };
    return mix(along_roughness(a.node), along_roughness(a.node + 1), a.f);
}

} // namespace

SpecularAlbedo specular_albedo(float roughness, float anisotropy, Vec3f wi) {
    const float root_z = std::sqrt(std::max(0.0f, wi.z));
    if (anisotropy <= 0.0f) return round_albedo(roughness, root_z);
    const float across = std::sqrt(wi.x * wi.x + wi.y * wi.y);
    const float cosine = across > 0.0f ? std::fabs(wi.x) / across : 1.0f;
    return stretched_albedo(roughness, anisotropy, root_z, cosine);
}

} // namespace heddle::detail
