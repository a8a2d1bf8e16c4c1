#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/io/curve/curve_files.h>
#include <heddle/io/file/input_file.h>

#include <cstdint>
#include <span>
#include <string>

namespace heddle {

/// Collects the problems of a file's curves, so that the user sees all of them after one run.
class ProblemList {
public:
    /// @param offset  byte of the problem; the first problem that was added is reported in full
    void add(std::uint64_t offset, const std::string& what, const std::string& fix);
    /// @throws Error  BadFile, one line: the first problem and the number of others
    void throw_if_any(const std::string& path) const;

private:
    std::uint64_t count_ = 0;
    std::uint64_t offset_ = 0;
    std::string what_;
    std::string fix_;
};

/// The smallest number of points of a curve that can be drawn: 2 for a polyline, 4 for an open
/// cubic (the end points only give tangents), 3 for a closed curve.
[[nodiscard]] std::uint64_t min_point_count(Basis basis, bool closed);

/// Adds a problem if curve `curve` has fewer points than its basis needs.
void check_point_count(Basis basis,
                       bool closed,
                       std::uint64_t curve,
                       std::uint64_t count,
                       std::uint64_t offset,
                       ProblemList& problems);

/// Adds a problem for the first point of a curve that is NaN or infinite.
/// @param offset  byte of points[0] in the file, 12 bytes per point
void check_finite(std::span<const Vec3f> points,
                  std::uint64_t curve,
                  std::uint64_t offset,
                  ProblemList& problems);

/// Adds a note if the file has bytes after the contents that its counts describe.
void note_trailing_bytes(const ByteReader& file, Geometry& geometry);

/// @throws Error  InvalidArgument: a radius that is negative or not finite, a repeat below 1
void check_options(const CurveReadOptions& options);

/// The Geometry that contains one set of curves: named by the path's stem, with one Fiber material.
[[nodiscard]] Geometry
make_curve_geometry(CurveSet set, const std::string& path, const std::string& material_name);

/// Sets the curves' radius: the option's, else an estimate from neighbouring yarns; notes which.
void settle_yarn_radius(const CurveReadOptions& options, Geometry& geometry);

/// Sets the curves' radius: the option's, else the default for hair; notes which.
void settle_hair_radius(const CurveReadOptions& options, Geometry& geometry);

/// A number as text with three digits, as notes show it.
[[nodiscard]] std::string three_digits(float x);

} // namespace heddle
