#include <heddle/scatter/azimuthal.h>
#include <heddle/scatter/fiber_frame.h>
#include <heddle/scatter/longitudinal.h>
#include <heddle/scatter/models.h>

#include <algorithm>
#include <cmath>

namespace heddle::detail {
namespace {

float mean(Vec3f c) {
    return (c.x + c.y + c.z) * (1.0f / 3.0f);
}

/// A width is the standard deviation of theta_o about -theta_i.
float variance(float width) {
    return std::max(kMinVariance, width * width);
}

/// The scale of the logistic from which the von Mises lobe is drawn: weights stay within 0.7 to 1.3
/// for widths up to 1 (measured).
float proposal_scale(float width) {
    return width * (0.6f + 0.35f * width);
}

struct LobeFiber {
    FiberFrame frame;
    float azimuth;
    Inclination in_r, in_tt;
    float v_r, v_tt;
    float kappa;
    CircleLogistic proposal;
    float choose_r; ///< probability of R

    LobeFiber(const ScatterMaterial& m, Vec3f axis, Vec3f wi)
        : frame(axis, wi),
          azimuth(std::min(10.0f, std::max(0.01f, m.azimuth_tt))),
          v_r(variance(m.width_r)),
          v_tt(variance(m.width_tt)),
          kappa(1.0f / (azimuth * azimuth)),
          proposal(proposal_scale(azimuth)) {
        const float s = std::sin(m.tilt);
        const float c = std::cos(m.tilt);
        in_r = turn(frame.in, 2.0f * s * c, c * c - s * s);
        in_tt = turn(frame.in, -s, c);
        const float r = mean(m.color_r);
        const float tt = mean(m.color_tt);
        choose_r = r + tt > 0.0f ? r / (r + tt) : 0.5f;
    }

    [[nodiscard]] ScatterValue value(const ScatterMaterial& m, Vec3f wo) const {
        const Vec3f w = frame.local(wo);
        const Inclination out{w.z, std::sqrt(w.x * w.x + w.y * w.y)};
        const float cosine = out.cos > 0.0f ? w.x / out.cos : 1.0f;
        const float r = longitudinal(in_r, out, v_r) * (0.5f * kInversePi);
        const float along_tt = longitudinal(in_tt, out, v_tt);
        // von Mises distribution about the far side
        const float tt = along_tt * exp_approx(-kappa * (1.0f + cosine)) * (0.5f * kInversePi) /
                         scaled_bessel_i0(kappa);
        const float behind = kPi - acos_approx(cosine);
        const float drawn = choose_r * r + (1.0f - choose_r) * along_tt * proposal.density(behind);
        return {m.color_r * r + m.color_tt * tt, drawn};
    }
};

} // namespace

ScatterValue lobe_fiber_value(const Scatterer& at, Vec3f wi, Vec3f wo) {
    return LobeFiber(at.material, at.axis, wi).value(at.material, wo);
}

ScatterDraw draw_lobe_fiber(const Scatterer& at, Vec3f wi, Vec3f u) {
    const LobeFiber fiber(at.material, at.axis, wi);
    const bool r = u.x < fiber.choose_r;
    // what is left of the uniform number after the choice is uniform again
    const float rest = r ? u.x / fiber.choose_r : (u.x - fiber.choose_r) / (1.0f - fiber.choose_r);
    const Inclination out = r ? sample_longitudinal(fiber.in_r, fiber.v_r, u.y, rest)
                              : sample_longitudinal(fiber.in_tt, fiber.v_tt, u.y, rest);
    const float phi = r ? kTwoPi * u.z : kPi + fiber.proposal.sample(u.z);
    const Vec3f local{out.cos * std::cos(phi), out.cos * std::sin(phi), out.sin};
    const Vec3f wo = normalize(fiber.frame.world(local));
    return {wo, fiber.value(at.material, wo)};
}

} // namespace heddle::detail
