#pragma once

#include <heddle/geom/yarn.h>

#include <cstdint>

namespace heddle {

/// The numbers of a YarnType that the paths of its fibers depend on, with the same names, in model
/// units. It is uploaded to the device.
struct YarnView {
    YarnModel model = YarnModel::Solid;
    bool ply_clockwise = false;
    bool fiber_clockwise = false;
    bool migration = false;
    bool flyaways = false;
    float radius = 0.0f; ///< scene units; 0: taken from the curves
    float model_radius = 1.0f;
    float reach = 0.0f; ///< yarn_reach()
    float fiber_radius = 0.0f;
    std::int32_t plies = 1;
    std::int32_t fibers_per_ply = 1;
    float ply_pitch = 1.0f;
    float fiber_pitch = 1.0f;
    float ply_offset = 0.0f;
    float ellipse_long = 1.0f;
    float ellipse_short = 1.0f;
    float migration_frequency = 1.0f;
    float migration_min = 1.0f;
    float migration_max = 1.0f;
    float hair_density = 0.0f;
    MeanSd hair_ze, hair_r0, hair_re, hair_pe;
    float loop_density = 0.0f;
    MeanSd loop_r1;
    float twist = 0.0f;
};
static_assert(sizeof(YarnView) == 116, "the same on host and device");

/// Returns the view of a yarn type.
[[nodiscard]] YarnView yarn_view(const YarnType& yarn);

} // namespace heddle
