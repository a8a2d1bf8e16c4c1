#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/yarn.h>

#include <cstdint>
#include <vector>

namespace heddle {

/// The fibers of one yarn, as constants of their paths about its centreline. Arrays of one length,
/// grouped by ply, with kSpare more entries of no meaning so that whole lanes can be read; model
/// units of the YarnType.
///
/// At yarn length s (model units) a procedural fiber lies, in its ply's frame (x towards the ply
/// from the yarn's axis), at (ply_offset + a cos(f) m, b sin(f) m), with f = its angle + 2 pi s /
/// fiber_pitch and m its migrating radius; the ply's frame turns by 2 pi s / ply_pitch     [Zhao
/// 2016, sec. 4]
struct FiberTable {
    std::vector<std::uint32_t> first_of_ply; ///< plies + 1 offsets
    std::vector<float> ply_cos, ply_sin;     ///< base angle of each ply
    std::vector<float> radius;               ///< distance from the ply's axis, of the unit section
    std::vector<float> cos_angle, sin_angle; ///< start angle in the ply's section
    std::vector<float> cos_migration, sin_migration; ///< start phase of the migration
    std::vector<float> migration_turns;              ///< the same phase, in turns
    std::vector<std::uint32_t> color; ///< linear RGB, 8 bits each; slices only, else white
    float fiber_radius = 0.0f;        ///< model units
    static constexpr std::size_t kSpare = 8;

    [[nodiscard]] std::size_t size() const {
        return first_of_ply.empty() ? 0 : first_of_ply.back();
    }
};

/// Places the fibers of yarn number `yarn` of its type: counter-based, the same in any order of
/// calls.
///
/// Procedural: radii by rejection from p(R) = (1 - 2 eps) ((e - e^R) / (e - 1))^beta + eps, angles
/// uniform [Zhao 2016, eq. 2]. Slice: fibers at points of the image drawn in proportion to its
/// alpha, stratified along its rows; their section times their number is the alpha's integral.
/// Solid: one fiber on the axis.
[[nodiscard]] FiberTable place_fibers(const YarnType& type, std::uint64_t seed, std::uint64_t yarn);

/// Largest distance of any fiber's surface from the centreline, flyaways included; model units.
[[nodiscard]] float yarn_reach(const YarnType& type);

} // namespace heddle
