#pragma once

#include <heddle/geom/fiber_table.h>
#include <heddle/geom/geometry.h>
#include <heddle/voxel/lattice_units.h>

#include <cstdint>
#include <vector>

namespace heddle {

/// A cubic piece P(t) = c[0] + c[1] t + c[2] t^2 + c[3] t^3, t in [0, 1], scene units.
struct Cubic {
    Vec3d c[4];
    [[nodiscard]] Vec3d at(double t) const { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); }
    [[nodiscard]] Vec3d derivative(double t) const {
        return c[1] + t * (2.0 * c[2] + (3.0 * t) * c[3]);
    }
    /// The part [t0, t0 + dt] as a cubic of its own.
    [[nodiscard]] Cubic part(double t0, double dt) const;
    /// Length of its control polygon: an upper bound of the arc's.
    [[nodiscard]] double polygon_length() const;
    /// Box of its control polygon: holds the arc.
    [[nodiscard]] Bounds hull() const;
};

/// Span `k` of a curve.
[[nodiscard]] Cubic span_cubic(const CurveSet& set, std::size_t curve, std::size_t k);

/// A piece of a span, short enough for single precision beside its anchor: what is binned to blocks.
struct FiberPiece {
    std::uint32_t set = 0;  ///< index into Geometry::curves
    std::uint32_t part = 0; ///< of `parts`
    std::uint32_t parts = 1;
    std::uint64_t curve = 0;
    std::uint64_t span = 0; ///< of the curve
    Cubic cubic;            ///< the piece itself
};

/// Where a yarn's twist stands: what a span needs beside its cubic. Lengths in model units.
struct YarnCourse {
    double start = 0.0;  ///< yarn length at the piece's start
    double length = 0.0; ///< of the piece
    double total = 0.0;  ///< of the whole yarn
    bool closed = false;
    double turns_per_length[3]{}; ///< plies, fibers, migration; whole turns over a closed yarn
    double closing_turns = 0.0;   ///< turn of the frame that closes a closed yarn, over its length
    Vec3f normal0, normal1;       ///< cross-section frame at the piece's ends
    float scale0 = 1.0f, scale1 = 1.0f; ///< units per model unit at the ends
};

/// The curves of a geometry as numbered pieces, with the arc lengths and the frames that yarns need.
///
/// Piece ids are dense per span: id = first_span + span, times kMaxParts, plus part.
class FiberSource {
public:
    static constexpr std::uint64_t kMaxParts = 1u << 16;

    FiberSource(const Geometry& geometry, const LatticeUnits& units, std::uint64_t seed);

    [[nodiscard]] std::uint64_t span_count() const { return first_span_.back(); }
    /// Span `span` (over all sets) as one piece, with the number of parts that it is cut into.
    [[nodiscard]] FiberPiece whole_span(std::uint64_t span) const;
    /// Part `part` of a whole span.
    [[nodiscard]] static FiberPiece part_of(const FiberPiece& span, std::uint32_t part);
    /// Distance from the piece's centreline within which it has matter; scene units.
    [[nodiscard]] double reach(const FiberPiece& piece) const;
    [[nodiscard]] YarnCourse course(const FiberPiece& piece) const;
    /// Fibers of one curve of the set, flyaway hairs not counted.
    [[nodiscard]] std::int64_t fiber_count(std::uint32_t set) const;

    [[nodiscard]] const Geometry& geometry() const { return geometry_; }
    [[nodiscard]] const LatticeUnits& units() const { return units_; }
    [[nodiscard]] std::uint64_t seed() const { return seed_; }
    [[nodiscard]] const YarnType* yarn_of(std::uint32_t set) const;
    [[nodiscard]] std::int64_t byte_count() const;
    /// Subvoxel edges of fiber length, counted along the centrelines.
    [[nodiscard]] double steps() const { return steps_; }

private:
    struct YarnFrames {
        std::vector<double> length; ///< at each knot of each curve, scene units: spans + 1 a curve
        std::vector<Vec3f> normal;  ///< at each knot
        std::vector<float> closing; ///< per curve, turns
    };
    struct SpanPlace {
        std::uint32_t set;
        std::uint64_t curve, k;
    };
    [[nodiscard]] SpanPlace place(std::uint64_t span) const;
    void build_frames(std::uint32_t set);
    void count_steps();

    const Geometry& geometry_;
    LatticeUnits units_;
    std::uint64_t seed_;
    std::vector<std::uint64_t> first_span_;               ///< per set, and the end
    std::vector<std::vector<std::uint64_t>> curve_spans_; ///< per set: first span of each curve
    std::vector<YarnFrames> frames_;                      ///< per set; empty for plain fibers
    double steps_ = 0.0;
};

} // namespace heddle
