#include <heddle/scatter/azimuthal.h>
#include <heddle/scatter/fiber_frame.h>
#include <heddle/scatter/longitudinal.h>
#include <heddle/scatter/models.h>

#include <heddle/base/random.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace heddle::detail {
namespace {

constexpr int kPaths = 3; ///< R, TT, TRT; the rest is even in azimuth
constexpr int kCells = 8; ///< in a fiber's half width, even in the angle of its normal to the light
/// sin(k pi / 16): the edges of the cells
constexpr float kEdge[kCells + 1] = {0.0f,        0.19509032f, 0.38268343f,
                                     0.55557023f, 0.70710678f, 0.83146961f,
                                     0.92387953f, 0.98078528f, 1.0f};
/// sin((k + 1/2) pi / 16): the middles of the cells; the cosines are the same in reverse
constexpr float kMiddle[kCells] = {0.09801714f, 0.29028468f, 0.47139674f, 0.63439328f,
                                   0.77301045f, 0.88192126f, 0.95694034f, 0.99518473f};
/// The unpolarized reflectance from outside.
/// @param c    cosine of the angle of incidence, in [0, 1]
/// @param eta  > 1
float fresnel(float c, float eta) {
    const float t = std::sqrt(1.0f - (1.0f - c * c) / (eta * eta));
    const float p = (eta * c - t) / (eta * c + t);
    const float s = (c - eta * t) / (c + eta * t);
    return 0.5f * (p * p + s * s);
}

float power_of_20(float x) {
    const float x4 = x * x * x * x;
    return x4 * x4 * x4 * x4 * x4;
}

/// Adds in the order of a vector's lanes.
float sum_of(const float (&x)[kCells]) {
    static_assert(kCells == 8);
    return ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]));
}

float clamp(float x, float low, float high) {
    return std::min(high, std::max(low, x));
}

/// The longitudinal variance of R; TT has a quarter of it, TRT four times.        [Chiang16]
float variance_of(float width_m) {
    const float w = clamp(width_m, 0.0f, 1.0f);
    const float root = 0.726f * w + 0.812f * w * w + 3.7f * power_of_20(w);
    return std::max(4.0f * kMinVariance, root * root);
}

/// The scale of the logistic of the azimuth.                                [Chiang16]
float scale_of(float width_n) {
    const float w = clamp(width_n, 0.05f, 1.0f);
    return 0.626657069f * (0.265f * w + 1.194f * w * w + 5.372f * power_of_20(w) * w * w);
}

constexpr int kChannels = 4; ///< red, green, blue, and their mean, by which paths are chosen

/// The light that leaves a fiber for one direction of incidence: all that does not depend on wo.
struct HairLobes {
    FiberFrame frame;
    CircleLogistic azimuth;
    float v[kPaths + 1];
    Inclination in[kPaths + 1];
    float phi[kPaths][kCells + 1];           ///< exit azimuth at the cells' edges
    float energy[kPaths][kChannels][kCells]; ///< of the cells of both halves together
    float rest[kChannels];                   ///< of the paths beyond TRT
    float total;                             ///< sum of all energies in the last channel

    HairLobes(const ScatterMaterial& m, Vec3f axis, Vec3f wi)
        : frame(axis, wi), azimuth(scale_of(m.width_n)) {
        const float r = variance_of(m.width_m);
        v[0] = r;
        v[1] = 0.25f * r;
        v[2] = v[3] = 4.0f * r;
        set_inclinations(m.tilt);
        const float eta = std::max(1.01f, m.eta);
        const float sine = clamp(frame.in.sin, -1.0f, 1.0f);
        const float cosine = std::max(1e-4f, frame.in.cos);
        // the effective index of refraction of the cross-section [Marschner 2003]
        const float eta_across = std::sqrt(std::max(1.0f, eta * eta - sine * sine)) / cosine;
        set_azimuths(eta_across);
        set_energies(m.absorption, eta, eta_across, sine, cosine);
    }

    /// The cone of light rotated by the tilt of the scales: R by 2 tilts towards the root, TT and
    /// TRT by 1 and 4 tilts towards the tip.                         [Marschner 2003; d'Eon 2011]
    void set_inclinations(float tilt) {
        const float s = std::sin(tilt);
        const float c = std::cos(tilt);
        const float s2 = 2.0f * s * c;
        const float c2 = c * c - s * s;
        in[0] = turn(frame.in, s2, c2);
        in[1] = turn(frame.in, -s, c);
        in[2] = turn(frame.in, -2.0f * s2 * c2, c2 * c2 - s2 * s2);
        in[3] = frame.in;
    }

    void set_azimuths(float eta_across) {
        constexpr float kStep = kPi / (2 * kCells);
        const float inverse = 1.0f / eta_across;
        for (int p = 0; p < kPaths; ++p) phi[p][0] = kPi * static_cast<float>(p);
        for (int k = 1; k <= kCells; ++k) {
            const float out = -2.0f * kStep * static_cast<float>(k);
            const float inside = kPi - 2.0f * acos_approx(kEdge[k] * inverse);
            phi[0][k] = out;
            phi[1][k] = inside + (out + kPi);
            phi[2][k] = 2.0f * inside + (out + kTwoPi);
        }
    }

    /// [Chiang16]: f, (1-f)^2 T, (1-f)^2 f T^2, and the geometric series of the rest
    void set_energies(Vec3f absorption, float eta, float eta_across, float sine, float cosine) {
        const float inverse = 1.0f / eta_across;
        const float steep = -2.0f / std::sqrt(1.0f - sine * sine / (eta * eta));
        float f[kCells];
        float path[kCells];
        float width[kCells];
        for (int k = 0; k < kCells; ++k) {
            width[k] = kEdge[k + 1] - kEdge[k];
            f[k] = fresnel(std::min(1.0f, cosine * kMiddle[kCells - 1 - k]), eta);
            const float h = kMiddle[k] * inverse;
            path[k] = steep * std::sqrt(1.0f - h * h);
        }
        for (int c = 0; c < 3; ++c) {
            const float sigma = std::max(0.0f, absorption[c]);
            float beyond[kCells];
            for (int k = 0; k < kCells; ++k) {
                const float T = exp_approx(sigma * path[k]);
                const float tt = width[k] * (1.0f - f[k]) * (1.0f - f[k]) * T;
                const float again = f[k] * T;
                energy[0][c][k] = width[k] * f[k];
                energy[1][c][k] = tt;
                energy[2][c][k] = tt * again;
                beyond[k] = tt * again * again / std::max(1e-6f, 1.0f - again);
            }
            rest[c] = sum_of(beyond);
        }
        rest[3] = (rest[0] + rest[1] + rest[2]) * (1.0f / 3.0f);
        total = rest[3];
        for (auto& e : energy) {
            for (int k = 0; k < kCells; ++k)
                e[3][k] = (e[0][k] + e[1][k] + e[2][k]) * (1.0f / 3.0f);
            total += sum_of(e[3]);
        }
    }

    /// Density in azimuth of the light that leaves through each cell of path p, mean of the two
    /// halves: the logistic averaged over the azimuths between the edges of the cell.
    void spread_over_cells(int p, float at, float (&density)[kCells]) const {
        float both[kCells + 1];
        both[0] = static_cast<float>(-p); // the edge at p half turns: the same for both halves
        for (int k = 1; k <= kCells; ++k) {
            both[k] = azimuth.cumulative(at - phi[p][k]) - azimuth.cumulative(at + phi[p][k]);
        }
        for (int k = 0; k < kCells; ++k) {
            density[k] = 0.5f * (both[k] - both[k + 1]) / (phi[p][k + 1] - phi[p][k]);
        }
        // if the exit azimuth reverses (a caustic of TRT), a cell has no width
        const float least = 0.02f * azimuth.scale();
        for (int k = 0; k < kCells; ++k) {
            if (std::fabs(phi[p][k + 1] - phi[p][k]) >= least) continue;
            const float middle = 0.5f * (phi[p][k] + phi[p][k + 1]);
            density[k] = 0.5f * (azimuth.density(at - middle) + azimuth.density(at + middle));
        }
    }

    [[nodiscard]] ScatterValue value(Vec3f wo) const {
        if (!(total > 0.0f)) return {};
        const Vec3f w = frame.local(wo);
        const Inclination out{w.z, std::sqrt(w.x * w.x + w.y * w.y)};
        const float at = std::atan2(w.y, w.x);
        float sum[kChannels][kCells]{};
        for (int p = 0; p < kPaths; ++p) {
            float density[kCells];
            spread_over_cells(p, at, density);
            const float along = longitudinal(in[p], out, v[p]);
            for (float& d : density) d = along * std::max(0.0f, d);
            for (int c = 0; c < kChannels; ++c) {
                for (int k = 0; k < kCells; ++k) sum[c][k] += energy[p][c][k] * density[k];
            }
        }
        const float even = longitudinal(in[kPaths], out, v[kPaths]) * (0.5f * kInversePi);
        const auto channel = [&](int c) { return sum_of(sum[c]) + rest[c] * even; };
        return {{channel(0), channel(1), channel(2)}, channel(3) / total};
    }
};

/// A path, a cell of it, and what is left of the uniform number that chose them.
struct Choice {
    int path = kPaths;
    int cell = 0;
    float left = 0.5f;
};

Choice choose(const HairLobes& lobes, float u) {
    float at = u * lobes.total;
    for (int p = 0; p < kPaths; ++p) {
        for (int k = 0; k < kCells; ++k) {
            const float e = lobes.energy[p][3][k];
            if (at < e) return {p, k, at / e};
            at -= e;
        }
    }
    return {kPaths, 0, std::min(0.9999999f, at / std::max(1e-30f, lobes.rest[3]))};
}

} // namespace

ScatterValue hair_value(const Scatterer& at, Vec3f wi, Vec3f wo) {
    return HairLobes(at.material, at.axis, wi).value(wo);
}

ScatterDraw draw_hair(const Scatterer& at, Vec3f wi, Vec3f u) {
    const HairLobes lobes(at.material, at.axis, wi);
    const Choice choice = choose(lobes, u.x);
    // two more uniform numbers from the bits of the three, which make the most important choices
    const std::uint64_t more =
        hash64(std::bit_cast<std::uint32_t>(u.x), std::bit_cast<std::uint32_t>(u.y),
               std::bit_cast<std::uint32_t>(u.z));
    const Inclination out =
        sample_longitudinal(lobes.in[choice.path], lobes.v[choice.path], u.z, to_unit_float(more));
    float phi = kTwoPi * u.y;
    if (choice.path < kPaths) {
        const float* edge = &lobes.phi[choice.path][choice.cell];
        const float left_half = to_unit_float(more << 24) < 0.5f ? -1.0f : 1.0f;
        phi = left_half * (edge[0] + choice.left * (edge[1] - edge[0])) + lobes.azimuth.sample(u.y);
    }
    const Vec3f local{out.cos * std::cos(phi), out.cos * std::sin(phi), out.sin};
    const Vec3f wo = normalize(lobes.frame.world(local));
    return {wo, lobes.value(wo)};
}

} // namespace heddle::detail
