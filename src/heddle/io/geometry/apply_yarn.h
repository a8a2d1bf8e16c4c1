#pragma once

#include <heddle/geom/geometry.h>

#include <cstdint>
#include <optional>
#include <string>

namespace heddle {

/// What a geometry's curves become.
struct YarnOptions {
    std::optional<std::string> yarn; ///< preset, or path of a yarn file; none: a curve is one fiber
    float yarn_radius = 0.0f;        ///< scene units; 0: what the curves say
    std::int64_t fibers = 0;         ///< in all of a yarn, needs `yarn`; 0: what the model says
    float fiber_radius = 0.0f; ///< unit of the yarn model; without `yarn`: of each curve, in scene
                               ///< units, before `yarn_radius`; 0: what the model says
};

/// Makes all curves the yarn, in a fiber material of its colour, or gives them the radius.
/// Geometry without curves stays as it is.
/// @throws Error  as read_yarn, read_image and set_fiber_count
void apply_yarn(Geometry& geometry, const YarnOptions& options);

} // namespace heddle
