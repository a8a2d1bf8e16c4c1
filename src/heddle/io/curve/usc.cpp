#include <heddle/base/error.h>
#include <heddle/io/curve/curve_checks.h>
#include <heddle/io/curve/curve_files.h>

#include <utility>

namespace heddle {
namespace {

/// Reads one strand; returns false if it is too short to draw and was dropped.
bool read_strand(ByteReader& file, std::uint64_t strand, CurveSet& set, ProblemList& problems) {
    const std::uint64_t at = file.offset();
    const std::int32_t count = file.i32("point count of a strand");
    if (count < 0) {
        file.fail(at, str("strand ", strand, " has ", count, " points, a count must be >= 0"),
                  "the file is damaged or of another kind; export it again");
    }
    const auto n = static_cast<std::uint64_t>(count);
    if (n < min_point_count(Basis::Linear, false)) {
        file.skip(n, sizeof(Vec3f), "points of a strand");
        return false;
    }
    file.require(n, sizeof(Vec3f), "points of a strand");
    const std::uint64_t begin = set.points.size();
    const std::uint64_t points_at = file.offset();
    set.points.resize(begin + n);
    const std::span<Vec3f> points = std::span(set.points).subspan(begin);
    file.fill(points, "points of a strand");
    check_finite(points, strand, points_at, problems);
    set.first.push_back(set.points.size());
    return true;
}

} // namespace

Geometry read_usc(const std::string& path, const CurveReadOptions& options) {
    check_options(options);
    ByteReader file(path);
    const std::int32_t strands = file.i32("strand count");
    if (strands <= 0) {
        file.fail(0, str("strand count is ", strands, ", it must be at least 1"),
                  "check that it is a USC .data file");
    }
    file.require(static_cast<std::uint64_t>(strands), 4, "strands");

    CurveSet set;
    set.basis = Basis::Linear;
    set.first.push_back(0);
    set.points.reserve(file.remaining() / sizeof(Vec3f)); // slightly more than possible
    std::uint64_t dropped = 0;
    ProblemList problems;
    for (std::int32_t s = 0; s < strands; ++s) {
        if (!read_strand(file, static_cast<std::uint64_t>(s), set, problems)) ++dropped;
    }
    problems.throw_if_any(path);
    if (set.points.empty()) {
        file.fail(0, str("none of its ", strands, " strands has 2 points or more"),
                  "export it again");
    }

    Geometry geometry = make_curve_geometry(std::move(set), path, "hair");
    if (dropped > 0) {
        geometry.notes.push_back(
            str(dropped, " of ", strands, " strands have fewer than 2 points and are dropped"));
    }
    note_trailing_bytes(file, geometry);
    settle_hair_radius(options, geometry);
    return geometry;
}

} // namespace heddle
