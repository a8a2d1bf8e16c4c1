#include <heddle/viewer/session/yarn_edit.h>

#include <heddle/geom/color.h>
#include <heddle/viewer/orbit.h>

#include <algorithm>
#include <cmath>

namespace heddle::viewer {
namespace {

std::uint32_t tinted(std::uint32_t color, Vec3f tint) {
    std::uint32_t out = 0;
    for (int c = 0; c < 3; ++c) {
        const auto old = static_cast<float>(color >> (8 * c) & 0xff);
        const float now = std::clamp(old * tint[c] + 0.5f, 0.0f, 255.0f);
        out |= static_cast<std::uint32_t>(now) << (8 * c);
    }
    return out;
}

/// Kinds may share a material, so points carry the tint, in point of the material's colour.
void tint_set(CurveSet& set, const Material& material, Vec3f tint) {
    if (tint == Vec3f{1.0f, 1.0f, 1.0f}) return;
    if (set.color.empty()) set.color.assign(set.points.size(), pack_color(material.albedo));
    for (std::uint32_t& c : set.color) c = tinted(c, tint);
}

std::size_t kind_of(const CurveSet& set, const Geometry& geometry) {
    return set.yarn < 0 ? geometry.yarns.size() : static_cast<std::size_t>(set.yarn);
}

} // namespace

std::vector<std::string> names_of_kinds(const Geometry& geometry) {
    std::vector<std::string> out;
    for (const YarnType& yarn : geometry.yarns) out.push_back(yarn.name);
    const bool plain = std::any_of(geometry.curves.begin(), geometry.curves.end(),
                                   [](const CurveSet& set) { return set.yarn < 0; });
    if (plain) out.emplace_back("fibers");
    return out;
}

Geometry edited(const Geometry& geometry, const std::vector<YarnEdit>& edits) {
    Geometry out = geometry;
    for (std::size_t y = 0; y < out.yarns.size(); ++y) {
        out.yarns[y].radius *= static_cast<float>(edits[y].radius);
        out.yarns[y].twist += static_cast<float>(edits[y].twist);
    }
    for (CurveSet& set : out.curves) {
        const YarnEdit& edit = edits[kind_of(set, geometry)];
        for (float& r : set.radius) r *= static_cast<float>(edit.radius);
        set.default_radius *= static_cast<float>(edit.radius);
        tint_set(set, out.materials[set.material], edit.tint);
    }
    return out;
}

void multiply_fibers(Geometry& geometry, double factor) {
    for (YarnType& yarn : geometry.yarns) {
        const double count = std::round(factor * static_cast<double>(yarn.slice_fibers));
        yarn.slice_fibers = static_cast<std::int32_t>(std::clamp(count, 1.0, 1.0e6));
    }
}

Bounds seen_bounds(const Geometry& geometry, const CameraParameters& camera, double aspect) {
    const CameraAxes axes(camera.eye - camera.target, camera.up);
    const double tall =
        camera.orthographic ? 0.5 * camera.view_height : std::tan(0.5 * camera.view_angle);
    Bounds out;
    for (const CurveSet& set : geometry.curves) {
        const YarnType* yarn = geometry.yarn_of(set);
        for (std::size_t i = 0; i < set.points.size(); ++i) {
            const Vec3d point = to_double(set.points[i]);
            const Vec3d seen = axes.of(point - camera.eye);
            const double at = camera.orthographic ? 1.0 : seen.z;
            if (!(at > 0.0) || std::fabs(seen.x) > tall * aspect * at ||
                std::fabs(seen.y) > tall * at) {
                continue;
            }
            const float fixed = yarn == nullptr ? 0.0f : yarn->radius;
            out.grow(point, static_cast<double>(std::max(fixed, set.radius_at(i))));
        }
    }
    return out;
}

} // namespace heddle::viewer
