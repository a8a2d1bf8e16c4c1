#pragma once

#include <heddle/geom/geometry.h>

#include <cstdint>
#include <optional>
#include <string_view>

namespace heddle {

/// What `generate` makes; nx and ny are its two counts.
enum class GenerateKind : std::uint8_t {
    Knit,    ///< stockinette: nx wales (columns of loops), ny courses (rows; one yarn each)
    Rib,     ///< 2 x 2 rib: nx wales, alternating two knit and two purl, ny courses
    Cable,   ///< cables of 2 over 2 wales on a purl ground: nx wales, ny courses
    Plain,   ///< plain weave: nx warp yarns, ny weft yarns
    Twill,   ///< 2/2 twill: nx warp yarns, ny weft yarns
    Satin,   ///< 5-harness warp-faced satin: nx warp yarns, ny weft yarns
    Hair,    ///< patch of bending strands: nx strands, ny points on each
    Curls,   ///< helical locks of 64 strands: nx strands, ny points on each
    Brushed, ///< plate with brushed scratches in its textures: nx x ny texels
    Grass    ///< nx leaf blades of ny quads each
};

/// The shape of a cloth; other kinds are always `Flat`.
enum class GenerateShape : std::uint8_t {
    Flat,   ///< in the xy plane, wales and warp along y, face towards +z
    Folded, ///< folded back and forth along y into a stack of layers, with round folds
    Hanging ///< hanging down -y in folds that deepen downward
};

/// What to generate. A zero count or length stands for the kind's default, which makes a swatch.
struct GenerateOptions {
    GenerateKind kind = GenerateKind::Knit;
    GenerateShape shape = GenerateShape::Flat;
    std::int64_t nx = 0;    ///< first count, as GenerateKind says; >= 1, or 0
    std::int64_t ny = 0;    ///< second count; >= 1 (hair: 2, curls: 2), or 0
    std::uint64_t seed = 1; ///< for hair, curls, brushed and grass; cloth is regular
    double radius = 0.0;    ///< of a yarn or strand; half the width of a blade; scene units
    double spacing = 0.0;   ///< between yarns (knit: wales), roots, or texels; scene units
};

/// The name on the command line: "knit", "rib", ...
[[nodiscard]] std::string_view to_string(GenerateKind kind);

/// The kind of that name; nothing if there is none.
[[nodiscard]] std::optional<GenerateKind> generate_kind_from(std::string_view name);

/// `options` with every zero replaced by its default.
/// @throws InvalidArgument: a count below the minimum or above what indices and textures hold, a
/// length that is negative or not finite, yarns so close that they must intersect, or a shape that
/// this kind, or a cloth as small as this, cannot have
[[nodiscard]] GenerateOptions resolve(const GenerateOptions& options);

/// The number of points that `generate` makes: control points of curves, or vertices of meshes.
/// @throws as `resolve`
[[nodiscard]] std::int64_t predict_nodes(const GenerateOptions& options);

/// The bytes of the arrays in the result of `generate`, which needs hardly any other memory.
/// @throws as `resolve`
[[nodiscard]] std::int64_t predict_bytes(const GenerateOptions& options);

/// Makes geometry from nothing: cloth and hair as curves, brushed metal and grass as meshes.
///
/// Yarns are uniform Catmull-Rom curves with one radius (`CurveSet::default_radius`) and yarn type
/// -1. Weaves wrap around each other in Peirce's arcs, stockinette touches and interlocks: neither
/// intersects. In a rib, threads between knit and purl wales overlap by up to a tenth of their
/// diameter; in a cable, one thread at each crossing by up to three quarters. Strands are polylines
/// that get thinner towards the tip. Time is linear in the number of points; all threads share the
/// work, and any number of them gives the same bits.
/// @throws as `resolve`; std::bad_alloc if memory does not suffice
[[nodiscard]] Geometry generate(const GenerateOptions& options);

} // namespace heddle
