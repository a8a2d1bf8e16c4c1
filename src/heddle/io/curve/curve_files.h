#pragma once

#include <heddle/geom/geometry.h>

#include <span>
#include <string>

namespace heddle {

/// Options for reading curve files.
struct CurveReadOptions {
    float radius = 0.0f; ///< scene units, >= 0; 0: the file's, else an estimate, with a note
    int repeat_x = 1;    ///< .pyp: tiles along x, >= 1
    int repeat_y = 1;    ///< .pyp: tiles along y, >= 1
};

// All readers return one CurveSet with one Fiber material ("yarn" or "hair"), the name from the
// path's stem, the coordinates of the file, and a note for each thing that was assumed or ignored.
// They throw Error: NotFound: no such file; BadFile: truncated, wrong magic bytes, inconsistent
// counts, no curves, NaN or infinite points, curves with too few points; InvalidArgument: an option
// out of range. Memory: the file's points once, and 64 KiB.

/// Reads Yuksel's yarn-level curves: `C0` uniform Catmull-Rom, `BS` cubic B-spline, `PL` polyline.
/// The end points of open C0 and BS curves only give tangents and stay among the points. The file
/// has no radius: estimate_radius gives one. A note tells the up axis. A closed cubic whose ends
/// are more than 16 of its longest steps apart is read as open, with a note (two in tea_cozy.bcc).
[[nodiscard]] Geometry read_bcc(const std::string& path, const CurveReadOptions& options = {});

/// Reads Yuksel's .hair strands: polylines from root to tip, as its specification says.
///
/// Every array but the points is optional; the defaults of the header replace missing ones. The
/// specification only says "thickness"; the groom importer of a game engine uses it as the strand's
/// width, so it is read as a diameter: radius = thickness / 2. Colours are read as linear.
/// Transparency is ignored. Strands of one point are dropped with a note.
[[nodiscard]] Geometry read_hair(const std::string& path, const CurveReadOptions& options = {});

/// Reads USC .data strands: polylines without radius (see default_hair_radius) or colour. Strands
/// of fewer than two points are dropped with a note.
[[nodiscard]] Geometry read_usc(const std::string& path, const CurveReadOptions& options = {});

/// Reads a MADYPG periodic yarn pattern and places repeat_x x repeat_y of its tiles side by side.
///
/// A yarn follows the edges [v0 v1 dx dy] from v0 in a tile to v1 in the tile (dx, dy) further.
/// Every edge of every tile is drawn once: a yarn that leaves the patch continues to the vertex
/// beyond the border, with the next vertex as its tangent point, so that patches side by side join
/// without gap or overlap. A yarn that closes within the patch is a closed curve. Twist angles,
/// rest lengths and directors are ignored.
/// @throws Error  also BadFile with a line: a row that cannot be parsed, a vertex with two
///                successors; InvalidArgument: more than 2^31 points
[[nodiscard]] Geometry read_pyp(const std::string& path, const CurveReadOptions& options = {});

/// True for the suffixes that `read_curves` supports: .bcc .hair .data .pyp, also in upper case.
[[nodiscard]] bool is_curve_file(const std::string& path);

/// Reads a curve file with the reader for its suffix.
/// @throws Error  also Unsupported: another suffix
[[nodiscard]] Geometry read_curves(const std::string& path, const CurveReadOptions& options = {});

/// Writes a .bcc: points, basis and whether curves are closed; it cannot store radius or material.
/// @param sets     written in order; at least one curve in all, one basis, each curve with enough
///                 points for it
/// @param up_axis  0 to 2, the axis that other programs take as up (2: flat patterns, 1: garments)
/// @throws Error   InvalidArgument: sets that read_bcc would refuse; as OutputFile
void write_bcc(std::span<const CurveSet> sets, const std::string& path, int up_axis = 2);
void write_bcc(const CurveSet& set, const std::string& path, int up_axis = 2);

/// Writes a .hair file: strands with thickness (2 x radius; an array if it varies) and colours, if
/// any.
/// @param set      basis Linear, no closed curves, at most 65535 segments per strand
/// @param color    linear RGB, the default of the header
/// @throws Error   InvalidArgument: what the format cannot hold; as OutputFile
void write_hair(const CurveSet& set, const std::string& path, Vec3f color = {1.0f, 1.0f, 1.0f});

} // namespace heddle
