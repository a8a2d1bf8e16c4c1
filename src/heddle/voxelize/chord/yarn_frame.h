#pragma once

#include <heddle/base/trig.h>
#include <heddle/voxel/lattice_units.h>
#include <heddle/voxelize/chord/fiber_tile.h>
#include <heddle/yarn/fiber_view.h>
#include <heddle/yarn/yarn_section.h>

#include <algorithm>
#include <cmath>

namespace heddle {

/// Largest length of a piece of a span, in units: half a block. So a long hair visits the blocks
/// along it and not all blocks of its box, and single precision resolves 1e-5 of a subvoxel near a
/// piece's anchor.
constexpr double kPieceUnits = 128.0;

/// Returns kPieceUnits in scene units, the piece length of the voxelizer's FiberSource.
[[nodiscard]] inline double piece_length_of(const LatticeUnits& units) {
    return kPieceUnits * units.unit;
}

/// A piece's cubic in units, relative to the corner of its anchor voxel.
struct LocalCubic : PowerCubic<float> {
    Vec3i anchor; ///< voxel index

    HEDDLE_HD LocalCubic(const Cubic& cubic, const LatticeUnits& u) {
        for (int a = 0; a < 3; ++a) {
            anchor[a] = static_cast<std::int32_t>(std::floor(cubic.c[0][a] / u.voxel_size[a]));
            const double corner = anchor[a] * u.voxel_size[a];
            c[0][a] = static_cast<float>((cubic.c[0][a] - corner) / u.unit);
            for (int i = 1; i < 4; ++i) c[i][a] = static_cast<float>(cubic.c[i][a] / u.unit);
        }
    }
    /// Returns the largest |P''|. P'' is linear in t, so the largest is at one of the ends.
    [[nodiscard]] HEDDLE_HD float bend() const {
        return std::max(length(second_derivative(0.0f)), length(second_derivative(1.0f)));
    }
};

/// A yarn's cross-section at one point, in units, from which the frames of its plies are computed.
struct YarnFrame : YarnSection<float> {
    SinCos ply;                  ///< angle since the yarn's start
    SinCos fiber{}, migration{}; ///< angles since the yarn's start, set by twist()

    HEDDLE_HD YarnFrame(const LocalCubic& cubic, const YarnCourse& course, float t)
        : YarnSection(cubic, course, t), ply(sincos_turns(course.ply_turns(s))) {}
    /// Sets the angles that fibers need in addition to their ply's frame.
    HEDDLE_HD void twist(const YarnCourse& course) {
        fiber = sincos_turns(course.turns_per_length[1] * s);
        migration = sincos_turns(course.turns_per_length[2] * s);
    }
    /// Returns the frame of a ply.
    /// @param base  angle of the ply at the yarn's start
    [[nodiscard]] HEDDLE_HD PlyFrame of_ply(SinCos base) const {
        const float c = (base.cos * ply.cos - base.sin * ply.sin) * scale;
        const float sn = (base.sin * ply.cos + base.cos * ply.sin) * scale;
        return {center, c * normal + sn * binormal, c * binormal - sn * normal, fiber, migration};
    }
};

} // namespace heddle
