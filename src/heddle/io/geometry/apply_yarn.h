#pragma once

#include <heddle/geom/geometry.h>

#include <cstdint>
#include <optional>
#include <string>

namespace heddle {

/// The yarn or radius that the curves of a geometry get.
struct YarnOptions {
    std::optional<std::string> yarn; ///< preset, or path of a yarn file; none: a curve is one fiber
    float yarn_radius = 0.0f;        ///< scene units; 0: as the curves say
    std::int64_t fibers = 0;         ///< of the whole yarn, needs `yarn`; 0: as the model says
    float fiber_radius = 0.0f; ///< unit of the yarn model; without `yarn`: of each curve, in scene
                               ///< units, before `yarn_radius`; 0: what the model says
};

/// Makes all curves the yarn, with a fiber material of its colour, or sets their radius. Geometry
/// without curves is unchanged.
/// @throws Error  as read_yarn, read_image and set_fiber_count
void apply_yarn(Geometry& geometry, const YarnOptions& options);

} // namespace heddle
