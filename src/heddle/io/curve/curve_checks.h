#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/io/curve/curve_files.h>
#include <heddle/io/file/input_file.h>

#include <cstdint>
#include <span>
#include <string>

namespace heddle {

/// Collects what is wrong with a file's curves, so that one run tells the user of all of it.
class ProblemList {
public:
    /// @param offset  byte of the trouble; the first added is the one that is told in full
    void add(std::uint64_t offset, const std::string& what, const std::string& fix);
    /// @throws Error  BadFile, one line: the first problem and how many more there are
    void throw_if_any(const std::string& path) const;

private:
    std::uint64_t count_ = 0;
    std::uint64_t offset_ = 0;
    std::string what_;
    std::string fix_;
};

/// Fewest points of a curve that has something to draw: 2 on a polyline, 4 on an open cubic (the
/// end points are phantoms), 3 on a closed curve.
[[nodiscard]] std::uint64_t min_point_count(Basis basis, bool closed);

/// Adds curve `curve` to `problems` if it has fewer points than its basis needs.
void check_point_count(Basis basis,
                       bool closed,
                       std::uint64_t curve,
                       std::uint64_t count,
                       std::uint64_t offset,
                       ProblemList& problems);

/// Adds the first point of a curve that is NaN or infinite to `problems`.
/// @param offset  byte of points[0] in the file, 12 bytes a point
void check_finite(std::span<const Vec3f> points,
                  std::uint64_t curve,
                  std::uint64_t offset,
                  ProblemList& problems);

/// Adds a note about bytes after the end of what the file's counts name.
void note_trailing_bytes(const ByteReader& file, Geometry& geometry);

/// @throws Error  InvalidArgument: a radius that is negative or not finite, a repeat below 1
void check_options(const CurveReadOptions& options);

/// The Geometry around one set of curves: name from the path's stem, one Fiber material.
[[nodiscard]] Geometry
make_curve_geometry(CurveSet set, const std::string& path, const std::string& material_name);

/// Gives `geometry`'s curves the option's radius, else the yarn estimate, and notes which.
void settle_yarn_radius(const CurveReadOptions& options, Geometry& geometry);

/// Gives `geometry`'s curves the option's radius, else the default for hair, and notes which.
void settle_hair_radius(const CurveReadOptions& options, Geometry& geometry);

/// Text of a number to three digits, as notes show it.
[[nodiscard]] std::string three_digits(float x);

} // namespace heddle
