#pragma once

#include <heddle/voxelize/test_voxelize.h>
#include <heddle/yarn/slice_image.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

// Slice yarns for the tests and the tables of bench/.

namespace heddle::slice::test {

/// A twisted slice of two plies with `fibers` fibers in all.
inline YarnType slice_yarn(float radius, int fibers = 90) {
    YarnType yarn;
    yarn.name = "two plies";
    yarn.model = YarnModel::Procedural;
    yarn.radius = radius;
    yarn.fiber_radius = 0.04f * std::sqrt(150.0f / static_cast<float>(fibers));
    yarn.plies = 2;
    yarn.fibers_per_ply = fibers / 2;
    yarn.ply_offset = 0.5f;
    yarn.ellipse_long = 0.5f;
    yarn.ellipse_short = 0.45f;
    yarn.ply_pitch = 12.0f;
    yarn.fiber_pitch = 12.0f;
    return make_slice(yarn, {.size = 128}).yarn;
}

/// Makes every curve of the geometry this yarn.
inline void set_yarn(Geometry& geometry, YarnType yarn) {
    geometry.yarns.assign(1, std::move(yarn));
    for (CurveSet& set : geometry.curves) set.yarn = 0;
}

/// A straight yarn of length 1 through the origin.
inline Geometry straight_yarn(Vec3f direction, YarnType yarn) {
    CurveSet set;
    const auto at = [&](float t) { return direction * t + Vec3f{0.013f, 0.007f, 0.003f}; };
    heddle::test::add_curve(set, {at(-1.5f), at(-0.5f), at(0.5f), at(1.5f)});
    Geometry geometry = heddle::test::geometry_of(set);
    set_yarn(geometry, std::move(yarn));
    return geometry;
}

} // namespace heddle::slice::test
