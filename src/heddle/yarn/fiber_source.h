#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/yarn/fiber_table.h>
#include <heddle/yarn/fiber_view.h>

#include <cstdint>
#include <vector>

namespace heddle {

/// Returns span `k` of a curve.
[[nodiscard]] Cubic span_cubic(const CurveSet& set, std::size_t curve, std::size_t k);

/// The curves of a geometry as numbered pieces, with the arc lengths and the frames that yarns
/// need. It owns the data that a FiberView points to; both use the functions of the view.
class FiberSource {
public:
    /// @param geometry      must outlive this, unchanged
    /// @param piece_length  largest length of a piece, scene units; infinite: spans are not divided
    FiberSource(const Geometry& geometry, double piece_length, std::uint64_t seed);

    /// Returns a view that is valid while this lives.
    [[nodiscard]] FiberView view() const {
        return {sets_.data(), first_span_.data(), sets_.size(), span_count(), seed_, piece_length_};
    }
    [[nodiscard]] std::uint64_t span_count() const { return first_span_.back(); }
    /// Returns span `span` (over all sets) as one piece, with the number of parts to divide it
    /// into.
    [[nodiscard]] FiberPiece whole_span(std::uint64_t span) const {
        return view().whole_span(span);
    }
    /// Returns the largest distance of the fibers' surfaces from the piece's centreline, scene
    /// units.
    [[nodiscard]] double reach(const FiberPiece& piece) const { return view().reach(piece); }
    /// Returns the twist and the frames of the yarn along the piece.
    /// @param unit  unit of YarnCourse::scale0 and scale1, scene units
    [[nodiscard]] YarnCourse course(const FiberPiece& piece, double unit) const {
        return view().course(piece, unit);
    }
    /// Returns the number of fibers of one curve of the set, without flyaway hairs.
    [[nodiscard]] std::int64_t fiber_count(std::uint32_t set) const;

    [[nodiscard]] const Geometry& geometry() const { return geometry_; }
    [[nodiscard]] std::uint64_t seed() const { return seed_; }
    [[nodiscard]] const YarnType* yarn_of(std::uint32_t set) const;
    [[nodiscard]] std::int64_t byte_count() const;
    /// Returns the length of all fibers, measured along the centrelines, in scene units.
    [[nodiscard]] double fiber_length() const { return fiber_length_; }

private:
    struct YarnFrames {
        std::vector<double> length; ///< see CurveSetView
        std::vector<Vec3f> normal;
        std::vector<float> closing;
    };
    void build_frames(std::uint32_t set);
    void measure_fibers();

    const Geometry& geometry_;
    double piece_length_;
    std::uint64_t seed_;
    std::vector<std::uint64_t> first_span_;               ///< of each set, and the end
    std::vector<std::vector<std::uint64_t>> curve_spans_; ///< per set: first span of each curve
    std::vector<YarnFrames> frames_;                      ///< per set; empty for plain fibers
    std::vector<CurveSetView> sets_;
    double fiber_length_ = 0.0;
};

} // namespace heddle
