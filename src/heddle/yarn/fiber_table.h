#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/yarn.h>

#include <cstdint>
#include <vector>

namespace heddle {

/// The constants of the paths of one yarn's fibers about its centreline, in model units. All arrays
/// per fiber have the same length and are grouped by ply. They are padded by kSpare entries so that
/// whole lanes can be read.
///
/// In the frame of its ply, whose x axis points from the yarn's axis to the ply, a procedural fiber
/// is at (ply_offset + a cos(f) m, b sin(f) m) at yarn length s. f is its angle + 2 pi s /
/// fiber_pitch, and m its migrating radius. The frame of the ply turns by 2 pi s / ply_pitch. [Zhao
/// 2016, sec. 4]
struct FiberTable {
    std::vector<std::uint32_t> first_of_ply; ///< plies + 1 offsets
    std::vector<float> ply_cos, ply_sin;     ///< base angle of each ply
    std::vector<float> radius;               ///< distance from the ply's axis in the unit section
    std::vector<float> cos_angle, sin_angle; ///< start angle in the ply's section
    std::vector<float> cos_migration, sin_migration; ///< start phase of the migration
    std::vector<float> migration_turns;              ///< the same phase, in turns
    std::vector<std::uint32_t> color; ///< linear RGB, 8 bits each; white except for slices
    float fiber_radius = 0.0f;        ///< model units
    static constexpr std::size_t kSpare = 8;

    [[nodiscard]] std::size_t size() const {
        return first_of_ply.empty() ? 0 : first_of_ply.back();
    }
};

/// Places the fibers of yarn number `yarn` of its type. Random numbers are counter-based, so the
/// result does not depend on the order of calls.
///
/// Procedural: radii by rejection from p(R) = (1 - 2 eps) ((e - e^R) / (e - 1))^beta + eps, uniform
/// angles [Zhao 2016, eq. 2]. Slice: random points of the image with a density proportional to its
/// alpha, stratified along its rows; the sum of the fibers' sections is the integral of alpha.
/// Solid: one fiber on the axis.
[[nodiscard]] FiberTable place_fibers(const YarnType& type, std::uint64_t seed, std::uint64_t yarn);

/// Returns the largest distance of any fiber's surface from the centreline, including flyaways, in
/// model units.
[[nodiscard]] float yarn_reach(const YarnType& type);

} // namespace heddle
