#pragma once

#include <heddle/base/progress.h>
#include <heddle/render/embree/round_curves.h>
#include <heddle/yarn/fiber_source.h>

#include <cstdint>

namespace heddle {

/// The yarns of one set of curves, and how finely their fibers are cut into cubics.
struct YarnSet {
    std::uint32_t set = 0;        ///< index into Geometry::curves
    std::uint64_t first_span = 0; ///< of the set, among all of the source's
};

/// Cubics per span of the yarn so that fibers stay within `tolerance` of the yarn model.
/// @param tolerance  in fiber radii; nine tenths of the sampled cubics keep to it
/// @return           1 to 16
[[nodiscard]] int choose_cubics(const FiberSource& source, YarnSet yarns, float tolerance);

/// Distance of cubics from the fibers that they stand for.
/// @return  in fiber radii: the 90th percentile, over sampled cubics, of each's largest distance
[[nodiscard]] double cubic_error(const FiberSource& source, YarnSet yarns, int cubics);

/// Segments that `yarn_curves` will give.
[[nodiscard]] std::uint64_t
count_yarn_segments(const FiberSource& source, YarnSet yarns, int cubics);

/// Fibers of a set's yarns, loops included, flyaway hairs not: Bezier cubics, each through four
/// evenly spaced places of its fiber. That is closer than what meets the fibers' places and
/// directions at its ends, and closer by far than a smooth spline: the yarn's frame, and with it
/// the fibers' direction, is only continuous at the knots.
/// @param cubics  per span of the yarn, >= 1
/// @throws Error  Unsupported: 2^32 control points or more; Cancelled
[[nodiscard]] RoundCurves
yarn_curves(const FiberSource& source, YarnSet yarns, int cubics, Progress& progress);

/// Flyaway hairs of a set's yarns.
/// @throws Error  Unsupported: 2^32 control points or more; Cancelled
[[nodiscard]] RoundCurves yarn_hairs(const FiberSource& source, YarnSet yarns, Progress& progress);

} // namespace heddle
