#pragma once

#include <heddle/base/function_ref.h>
#include <heddle/geom/generate.h>

#include <cstddef>
#include <cstdint>
#include <vector>

/// The generators of each kind; only `generate` calls them, with options that `resolve` returned.
namespace heddle::generate_parts {

/// Array sizes of a result, known before it is made.
struct Sizes {
    std::vector<std::int64_t> curves;    ///< per curve set
    std::vector<std::int64_t> per_curve; ///< points on each curve, per curve set
    bool point_radius = false;           ///< each curve point has its own radius
    std::int64_t vertices = 0;
    std::int64_t triangles = 0;
    bool tangents = false;
    std::int64_t texel_bytes = 0;
};

/// Control points of a knitted stitch: the chords are a twentieth of its length.
inline constexpr std::int64_t kStitchPoints = 20;
/// Control points from one crossing of a weave to the next.
inline constexpr std::int64_t kCrossingPoints = 8;
/// Texels of the brushed plate that one quad of its mesh spans along an axis.
inline constexpr std::int64_t kQuadTexels = 16;
/// Grass leaf atlas: four leaf shapes side by side, RGBA.
inline constexpr std::int32_t kLeafWidth = 64;
inline constexpr std::int32_t kLeafHeight = 256;
inline constexpr std::int32_t kLeafShapes = 4;
/// Strands of one lock of curls.
inline constexpr std::int64_t kLockStrands = 64;

/// Wale spacing at which a stockinette of yarn radius 1 is as tight as its loop shape allows.
inline constexpr double kTightestWale = 8.2;
/// Spacing at which a plain weave of yarn radius 1 jams: 4 sin 60 degrees   [Peirce 1937]
inline constexpr double kJammedWeave = 3.4641016151377544;

/// The thickness of the cloth, between the outer surfaces of its yarns; scene units.
[[nodiscard]] double cloth_thickness(const GenerateOptions& options);

/// Curves of equal length whose points are still zero.
[[nodiscard]] CurveSet
make_empty_curves(std::int64_t curves, std::int64_t points_per_curve, Basis basis);

/// Curves of equal length with the points `point_at(curve, point)`, evaluated on all threads.
[[nodiscard]] CurveSet make_curves(std::int64_t curves,
                                   std::int64_t points_per_curve,
                                   Basis basis,
                                   FunctionRef<Vec3d(std::int64_t, std::int64_t)> point_at);

[[nodiscard]] Sizes sizes(const GenerateOptions& options);
[[nodiscard]] Geometry generate_knit(const GenerateOptions& options);
[[nodiscard]] Geometry generate_weave(const GenerateOptions& options);
[[nodiscard]] Geometry generate_hair(const GenerateOptions& options);
[[nodiscard]] Geometry generate_brushed(const GenerateOptions& options);
[[nodiscard]] Geometry generate_grass(const GenerateOptions& options);

} // namespace heddle::generate_parts
