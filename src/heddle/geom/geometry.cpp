#include <heddle/geom/geometry.h>

#include <algorithm>

namespace heddle {
namespace {

/// The radius of a fiber of the yarn, relative to the yarn's radius.
double share_of_yarn(const YarnType& yarn) {
    if (yarn.model == YarnModel::Solid) return 1.0;
    return static_cast<double>(yarn.fiber_radius) / static_cast<double>(yarn.model_radius);
}

} // namespace

CurveRadii radii_of(const CurveSet& set, const YarnType* yarn) {
    if (yarn != nullptr && yarn->radius > 0.0f) return {yarn->radius, yarn->radius};
    if (set.radius.empty()) return {set.default_radius, set.default_radius};
    const auto [least, most] = std::minmax_element(set.radius.begin(), set.radius.end());
    return {*least, *most};
}

float mean_fiber_radius(const Geometry& geometry, std::uint32_t material) {
    double sum = 0.0;
    double points = 0.0;
    for (const CurveSet& set : geometry.curves) {
        if (set.material != material) continue;
        const YarnType* yarn = geometry.yarn_of(set);
        const double share = yarn == nullptr ? 1.0 : share_of_yarn(*yarn);
        const bool fixed = yarn != nullptr && yarn->radius > 0.0f;
        for (std::size_t i = 0; i < set.points.size(); ++i) {
            const float radius = fixed ? yarn->radius : set.radius_at(i);
            sum += share * static_cast<double>(radius);
        }
        points += static_cast<double>(set.points.size());
    }
    return points > 0.0 ? static_cast<float>(sum / points) : 0.0f;
}

} // namespace heddle
