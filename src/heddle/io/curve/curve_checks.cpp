#include <heddle/io/curve/curve_checks.h>

#include <heddle/base/error.h>
#include <heddle/io/curve/estimate_radius.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <utility>

namespace heddle {
namespace {

constexpr const char* kRadiusOption = "set it with --yarn-radius";

/// Rounds to the digits that notes show: as an option, the number in a note gives the same result.
float round_to_three_digits(float x) {
    return std::strtof(three_digits(x).c_str(), nullptr);
}

/// Returns true if the option sets the radius.
bool take_radius_option(const CurveReadOptions& options, CurveSet& set) {
    if (options.radius <= 0.0f) return false;
    set.radius.clear();
    set.default_radius = options.radius;
    return true;
}

} // namespace

void ProblemList::add(std::uint64_t offset, const std::string& what, const std::string& fix) {
    if (count_++ > 0) return;
    offset_ = offset;
    what_ = what;
    fix_ = fix;
}

void ProblemList::throw_if_any(const std::string& path) const {
    if (count_ == 0) return;
    const std::string more = count_ == 1   ? std::string()
                             : count_ == 2 ? " (and 1 more problem)"
                                           : str(" (and ", count_ - 1, " more problems)");
    throw Error(ErrorCode::BadFile, what_ + more, fix_,
                {.path = path, .offset = static_cast<std::int64_t>(offset_)});
}

std::uint64_t min_point_count(Basis basis, bool closed) {
    if (closed) return 3;
    return basis == Basis::Linear ? 2 : 4;
}

void check_point_count(Basis basis,
                       bool closed,
                       std::uint64_t curve,
                       std::uint64_t count,
                       std::uint64_t offset,
                       ProblemList& problems) {
    const std::uint64_t least = min_point_count(basis, closed);
    if (count >= least) return;
    const char* kind = closed                   ? "a closed curve"
                       : basis == Basis::Linear ? "a polyline"
                                                : "a cubic";
    problems.add(offset,
                 str("curve ", curve, " has ", count, " control point", count == 1 ? "" : "s", ", ",
                     kind, " needs at least ", least),
                 least == 4 && count >= 2 ? "drop the curve or store it as 'PL'"
                                          : "drop the curve");
}

void check_finite(std::span<const Vec3f> points,
                  std::uint64_t curve,
                  std::uint64_t offset,
                  ProblemList& problems) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (int a = 0; a < 3; ++a) {
            if (std::isfinite(points[i][a])) continue;
            problems.add(offset + 12 * i + 4 * static_cast<std::uint64_t>(a),
                         str("point ", i, " of curve ", curve, " has ", "xyz"[a], " = ",
                             points[i][a], ", it must be finite"),
                         "drop the curve or export it again");
            return;
        }
    }
}

void note_trailing_bytes(const ByteReader& file, Geometry& geometry) {
    if (file.remaining() == 0) return;
    geometry.notes.push_back(str(file.remaining(), " byte", file.remaining() == 1 ? "" : "s",
                                 " after the last curve, from byte ", file.offset(),
                                 " on, are not read"));
}

void check_options(const CurveReadOptions& options) {
    if (!std::isfinite(options.radius) || options.radius < 0.0f) {
        throw Error(ErrorCode::InvalidArgument,
                    str("yarn radius is ", options.radius, ", it must be finite and > 0"),
                    "leave it out to have it estimated");
    }
    if (options.repeat_x < 1 || options.repeat_y < 1) {
        throw Error(ErrorCode::InvalidArgument, str("repeat is ", options.repeat_x, " x ",
                                                    options.repeat_y, ", both must be at least 1"));
    }
}

Geometry
make_curve_geometry(CurveSet set, const std::string& path, const std::string& material_name) {
    Geometry g;
    g.name = std::filesystem::path(path).stem().string();
    Material material;
    material.name = material_name;
    material.kind = MaterialKind::Fiber;
    g.materials.push_back(std::move(material));
    set.material = 0;
    set.yarn = -1;
    g.curves.push_back(std::move(set));
    return g;
}

void settle_yarn_radius(const CurveReadOptions& options, Geometry& geometry) {
    CurveSet& set = geometry.curves.front();
    if (take_radius_option(options, set)) return;
    set.default_radius = round_to_three_digits(estimate_radius(set));
    if (set.default_radius > 0.0f) {
        geometry.notes.push_back(str("radius ", three_digits(set.default_radius),
                                     " estimated from the distance between neighbouring yarns; ",
                                     kRadiusOption));
        return;
    }
    // No yarn is beside it: a hundredth of its extent is thin enough for a yarn and thick enough to
    // be visible.
    set.default_radius = round_to_three_digits(40.0f * default_hair_radius(set));
    geometry.notes.push_back(
        str("radius ", three_digits(set.default_radius),
            " is 1/100 of the longest side: there are no neighbouring yarns to estimate it from; ",
            kRadiusOption));
}

void settle_hair_radius(const CurveReadOptions& options, Geometry& geometry) {
    CurveSet& set = geometry.curves.front();
    if (take_radius_option(options, set)) return;
    set.radius.clear();
    set.default_radius = round_to_three_digits(default_hair_radius(set));
    geometry.notes.push_back(
        str("radius ", three_digits(set.default_radius),
            " is the default for hair, 1/4000 of the longest side: the file names none; ",
            kRadiusOption));
}

std::string three_digits(float x) {
    std::ostringstream out;
    out << std::setprecision(3) << x;
    return std::move(out).str();
}

} // namespace heddle
