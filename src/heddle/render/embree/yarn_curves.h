#pragma once

#include <heddle/base/progress.h>
#include <heddle/render/embree/round_curves.h>
#include <heddle/yarn/fiber_source.h>

#include <cstdint>

namespace heddle {

/// The yarns of one set of curves.
struct YarnSet {
    std::uint32_t set = 0;        ///< index into Geometry::curves
    std::uint64_t first_span = 0; ///< first span of the set among all spans of the source
    double unit = 1.0;            ///< unit of the courses' scales, scene units
};

/// Chooses how many cubics per span of the yarn keep fibers within `tolerance` of the yarn model.
/// @param tolerance  in fiber radii; holds for nine tenths of the sampled cubics
/// @return           cubics per span, 1 to 16
[[nodiscard]] int choose_cubics(const FiberSource& source, YarnSet yarns, float tolerance);

/// Measures the distance of cubics from the fibers that they approximate.
/// @return  in fiber radii: the 90th percentile of the largest distances of sampled cubics
[[nodiscard]] double cubic_error(const FiberSource& source, YarnSet yarns, int cubics);

/// Returns the number of segments that yarn_curves() will return.
[[nodiscard]] std::uint64_t
count_yarn_segments(const FiberSource& source, YarnSet yarns, int cubics);

/// Returns the fibers of a set's yarns, with loops but without flyaway hairs, as Bezier cubics,
/// each through four evenly spaced points of its fiber. They are closer to the fibers than Hermite
/// cubics, and much closer than a smooth spline, as the yarn frame and with it the directions of
/// fibers are continuous at the knots but not smooth.
/// @param cubics  per span of the yarn, >= 1
/// @throws Error  Unsupported: 2^32 control points or more; Cancelled
[[nodiscard]] RoundCurves
yarn_curves(const FiberSource& source, YarnSet yarns, int cubics, Progress& progress);

/// Returns the flyaway hairs of a set's yarns.
/// @throws Error  Unsupported: 2^32 control points or more; Cancelled
[[nodiscard]] RoundCurves yarn_hairs(const FiberSource& source, YarnSet yarns, Progress& progress);

} // namespace heddle
