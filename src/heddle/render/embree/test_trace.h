#pragma once

#include <heddle/base/random.h>
#include <heddle/render/embree/embree_scene.h>
#include <heddle/voxelize/test_voxelize.h>

#include <memory>
#include <utility>
#include <vector>

// Traces small geometry in tests.

namespace heddle::test {

/// Builds a scene of the geometry, all of whose materials scatter as `material`.
inline std::unique_ptr<SurfaceScene> trace(Geometry geometry,
                                           const ScatterMaterial& material = {},
                                           std::vector<Affine> instances = {Affine{}},
                                           const EmbreeOptions& options = {}) {
    auto shared = std::make_shared<const Geometry>(std::move(geometry));
    const TracedObject object{shared, std::move(instances),
                              std::vector<std::uint32_t>(shared->materials.size(), 0)};
    Progress silent;
    return build_embree_scene({&object, 1}, {material}, silent, options);
}

inline Ray ray_to(Vec3d from, Vec3d to) {
    Ray ray;
    ray.origin = from;
    ray.direction = to_float(normalize(to - from));
    return ray;
}

/// Draws a direction uniformly on the sphere.
inline Vec3d draw_direction(StreamRandom& random) {
    for (;;) {
        const Vec3d d{2.0 * static_cast<double>(random.uniform()) - 1.0,
                      2.0 * static_cast<double>(random.uniform()) - 1.0,
                      2.0 * static_cast<double>(random.uniform()) - 1.0};
        const double n = length(d);
        if (n > 1e-3 && n <= 1.0) return d * (1.0 / n);
    }
}

/// Returns one straight fiber from `from` to `to` of radius r.
inline Geometry straight_fiber(Basis basis, Vec3f from, Vec3f to, float r) {
    CurveSet set;
    set.basis = basis;
    set.default_radius = r;
    std::vector<Vec3f> points;
    const int n = basis == Basis::Linear ? 3 : 6;
    for (int i = 0; i < n; ++i) {
        points.push_back(from + (to - from) * (static_cast<float>(i) / static_cast<float>(n - 1)));
    }
    add_curve(set, points);
    return geometry_of(set);
}

} // namespace heddle::test
