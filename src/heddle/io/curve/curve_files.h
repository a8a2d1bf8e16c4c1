#pragma once

#include <heddle/geom/geometry.h>

#include <span>
#include <string>

namespace heddle {

/// How curve files are read.
struct CurveReadOptions {
    float radius = 0.0f; ///< scene units, >= 0; 0: the file's, else estimated (and noted)
    int repeat_x = 1;    ///< .pyp: tiles along x, >= 1
    int repeat_y = 1;    ///< .pyp: tiles along y, >= 1
};

// All readers return one CurveSet with one Fiber material ("yarn" or "hair"), the name from the
// path's stem, coordinates as the file has them, and a note for each thing that was assumed or
// passed over. They throw Error: NotFound: no such file; BadFile: cut short, wrong magic, counts
// that do not fit, no curves, NaN or infinite points, curves with too few points; InvalidArgument:
// an option out of range. Memory: the file's points once, and 64 KiB.

/// Reads Yuksel's yarn-level curves: `C0` uniform Catmull-Rom, `BS` cubic B-spline, `PL` polyline.
/// The end points of an open C0 or BS curve are phantoms and stay among the points. The file holds
/// no radius: see estimate_radius. The up axis is told in the notes. A cubic marked closed whose
/// ends are more than 16 of its longest steps apart is read as open, with a note (two in
/// tea_cozy.bcc).
[[nodiscard]] Geometry read_bcc(const std::string& path, const CurveReadOptions& options = {});

/// Reads Yuksel's .hair strands: polylines, as its specification says, root to tip.
///
/// Every array but the points is optional; the header's defaults stand in. The specification says
/// "thickness" and no more; the groom importer of a game engine that was looked at passes it on as
/// the strand's width, so it is taken as a diameter: radius = thickness / 2. Colours are taken as
/// linear. Transparency is not used. Strands of one point are dropped with a note.
[[nodiscard]] Geometry read_hair(const std::string& path, const CurveReadOptions& options = {});

/// Reads USC .data strands: polylines without radius (see default_hair_radius) or colour.
/// Strands of no or one point are dropped with a note.
[[nodiscard]] Geometry read_usc(const std::string& path, const CurveReadOptions& options = {});

/// Reads a MADYPG periodic yarn pattern and lays repeat_x x repeat_y of its tiles side by side.
///
/// Yarns follow the edges [v0 v1 dx dy] from v0 in a tile to v1 in the tile (dx, dy) further. Every
/// edge of every tile is drawn once: where a yarn leaves the patch it runs on to the node beyond
/// the border, with the node after that as its phantom, so patches laid beside each other join
/// without gap or overlap. A yarn that closes within the patch is a closed curve. Twist angles,
/// rest lengths and directors are not used.
/// @throws Error  also BadFile with a line: a row that does not parse, a vertex with two ways on;
///                InvalidArgument: more than 2^31 points
[[nodiscard]] Geometry read_pyp(const std::string& path, const CurveReadOptions& options = {});

/// True for the suffixes that `read_curves` knows: .bcc .hair .data .pyp, upper case too.
[[nodiscard]] bool is_curve_file(const std::string& path);

/// Reads a curve file by its suffix.
/// @throws Error  also Unsupported: another suffix
[[nodiscard]] Geometry read_curves(const std::string& path, const CurveReadOptions& options = {});

/// Writes .bcc: points, basis and closedness. Radius, colour and material have no place in it.
/// @param sets     one after the other; at least one curve in all, one basis, each curve with enough
///                 points for it
/// @param up_axis  0 to 2, what other programs will take as up (2: flat patterns, 1: garments)
/// @throws Error   InvalidArgument: sets that read_bcc would refuse; as OutputFile
void write_bcc(std::span<const CurveSet> sets, const std::string& path, int up_axis = 2);
void write_bcc(const CurveSet& set, const std::string& path, int up_axis = 2);

/// Writes .hair: strands with thickness (2 x radius; an array if it varies) and colours if there
/// are.
/// @param set      basis Linear, no closed curves, at most 65535 segments a strand
/// @param color    linear RGB, the header's default
/// @throws Error   InvalidArgument: what the format cannot hold; as OutputFile
void write_hair(const CurveSet& set, const std::string& path, Vec3f color = {1.0f, 1.0f, 1.0f});

} // namespace heddle
