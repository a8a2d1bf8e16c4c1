#include <heddle/scatter/approximate.h>
#include <heddle/scatter/draw.h>
#include <heddle/scatter/fiber_frame.h>
#include <heddle/scatter/models.h>

#include <cmath>

namespace heddle::detail {
namespace {

/// cos(theta_o) ((pi - d) cos d + sin d) / (4 pi), where d is the azimuth between wi and wo: the
/// mean of <n . wo> / pi over the normals that wi sees. wi's inclination cancels. [docs/scatter.md]
/// @param w  wo in the fiber's frame
float density(Vec3f w) {
    const float c = std::sqrt(w.x * w.x + w.y * w.y);
    if (!(c > 0.0f)) return 0.0f;
    const float from_back = acos_approx(-w.x / c); // pi - d
    const float sum = from_back * w.x + std::fabs(w.y);
    return std::max(0.0f, sum) * (0.25f * kInversePi); // at d = pi, rounding can give less than 0
}

} // namespace

ScatterValue lambert_fiber_value(const Scatterer& at, Vec3f wi, Vec3f wo) {
    const float d = density(FiberFrame(at.axis, wi).local(wo));
    return {at.material.albedo * d, d};
}

ScatterDraw draw_lambert_fiber(const Scatterer& at, Vec3f wi, Vec3f u) {
    const FiberFrame frame(at.axis, wi);
    const float s = 2.0f * u.z - 1.0f; // visible normals are even across the fiber's width
    const float c = std::sqrt(std::max(0.0f, 1.0f - s * s));
    const Vec3f normal = frame.x * c + frame.y * s;
    const Vec3f across = frame.y * c - frame.x * s;
    const Vec3f wo = to_world(sample_cosine(u.x, u.y), across, frame.axis, normal);
    const float d = density(frame.local(wo));
    return {wo, {at.material.albedo * d, d}};
}

} // namespace heddle::detail
