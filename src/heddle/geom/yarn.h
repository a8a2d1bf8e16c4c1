#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/texture.h>

#include <cstdint>
#include <string>

namespace heddle {

enum class YarnModel : std::uint8_t {
    Solid,      ///< one round fiber as thick as the yarn
    Procedural, ///< plies of fibers    [Zhao 2016, "Fitting procedural yarn models"]
    Slice       ///< an RGBA cross-section, swept and twisted          [LopezMoreno17, 3.2, 3.3]
};

/// Mean and standard deviation of a normal distribution.
struct MeanSd {
    float mean = 0.0f;
    float sd = 0.0f;
};

/// A yarn's cross-section, and how it runs along the centreline. Lengths of the procedural and
/// slice models are in model units, in which the yarn's radius is `model_radius`; a yarn of radius
/// R in the scene is this model scaled by R / model_radius.
struct YarnType {
    std::string name = "solid";
    YarnModel model = YarnModel::Solid;
    float radius = 0.0f;            ///< radius of the yarn, scene units; 0: taken from the curves
    float model_radius = 1.0f;      ///< the yarn's radius in model units (Zhao's `yarn_radius`)
    float fiber_radius = 0.0f;      ///< model units; > 0 (readers fill in a default and report it)
    Vec3f albedo{0.8f, 0.8f, 0.8f}; ///< linear RGB

    // procedural
    std::int32_t plies = 1;
    std::int32_t fibers_per_ply = 1;
    bool ply_clockwise = false;   ///< direction of the plies about the yarn (yarn_clock_wise)
    bool fiber_clockwise = false; ///< direction of the fibers about their ply
    float ply_pitch = 1.0f;       ///< yarn length of one turn of the plies (yarn_alpha)
    float fiber_pitch = 1.0f;     ///< yarn length of one turn of the fibers (alpha)
    float ply_offset = 0.0f;      ///< distance of a ply's axis from the yarn's (yarn_radius / 2)
    float ellipse_long = 1.0f;    ///< half axis of a ply's section, across the one towards the axis
    float ellipse_short = 1.0f;   ///< half axis of a ply's section towards the yarn's axis
    float density_epsilon = 0.0f; ///< p(R) ~ (1 - 2 eps) ((e - e^R) / (e - 1))^beta + eps
    float density_beta = 0.2f;
    float density_r_max = 1.0f; ///< R in [0, r_max], in the unit section of a ply
    /// R(z) = R/2 (max + min + (max - min) cos(theta_i + s 2 pi z / pitch))
    bool migration = false;
    float migration_frequency = 1.0f; ///< s_i
    float migration_min = 1.0f;
    float migration_max = 1.0f;
    bool flyaways = false;
    float hair_density = 0.0f; ///< hairs per ply and model unit of length
    /// extent along z, start radius, radial extent, angle
    MeanSd hair_ze, hair_r0, hair_re, hair_pe;
    float loop_density = 0.0f; ///< loops per ply and model unit of length
    MeanSd loop_r1;            ///< distance from the ply's axis that a loop reaches

    // slice
    Texture slice;      ///< RGB: albedo, A: volume fraction of fibers; fills [-radius, radius]^2
    float twist = 0.0f; ///< radians per model unit, counter-clockwise seen against the yarn
    std::int32_t slice_fibers = 150; ///< number of fibers that represent the slice

    /// The number of fibers of one yarn, without flyaway hairs.
    [[nodiscard]] std::int64_t fiber_count() const {
        switch (model) {
        case YarnModel::Solid: return 1;
        case YarnModel::Procedural: return std::int64_t{plies} * fibers_per_ply;
        case YarnModel::Slice: return slice_fibers;
        }
        return 1;
    }
};

} // namespace heddle
