#include <heddle/base/error.h>
#include <heddle/io/curve/curve_checks.h>
#include <heddle/io/curve/curve_files.h>
#include <heddle/io/file/output_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace heddle {
namespace {

enum Arrays : std::uint32_t {
    kSegments = 1,
    kPoints = 2,
    kThickness = 4,
    kTransparency = 8,
    kColors = 16,
    kKnown = 31
};
constexpr std::uint64_t kInfoBytes = 88;

struct HairHeader {
    std::uint32_t strands = 0;
    std::uint32_t points = 0;
    std::uint32_t arrays = 0;
    std::uint32_t segments = 0; ///< of every strand, if there is no segments array
    float thickness = 0.0f;     ///< a diameter, scene units
    float transparency = 0.0f;
    Vec3f color;

    [[nodiscard]] bool has(Arrays array) const { return (arrays & array) != 0; }
};

HairHeader read_header(ByteReader& file) {
    if (file.remaining() < 4 || file.text(4, "magic") != "HAIR") {
        file.fail(0, "is not a .hair file: it does not start with 'HAIR'", "check the file's kind");
    }
    HairHeader h;
    h.strands = file.u32("strand count");
    h.points = file.u32("point count");
    h.arrays = file.u32("array bits");
    h.segments = file.u32("default segments");
    h.thickness = file.f32("default thickness");
    h.transparency = file.f32("default transparency");
    h.color = {file.f32("default red"), file.f32("default green"), file.f32("default blue")};
    file.skip(1, kInfoBytes, "info");
    if (!h.has(kPoints)) {
        file.fail(12, "holds no points array (bit 2 is not set)", "export it with points");
    }
    if (h.strands == 0 || h.points == 0) {
        file.fail(h.strands == 0 ? 4 : 8, str("holds no ", h.strands == 0 ? "strands" : "points"),
                  "export it again");
    }
    return h;
}

/// The offset of every strand's first point, from the segments array or the default.
std::vector<std::uint64_t> read_offsets(ByteReader& file, const HairHeader& h) {
    const std::uint64_t at = file.offset();
    std::vector<std::uint16_t> segments;
    if (h.has(kSegments)) {
        segments = file.array<std::uint16_t>(h.strands, "segments");
    } else if (std::uint64_t{h.strands} * (std::uint64_t{h.segments} + 1) != h.points) {
        // before memory is allocated for the offsets: nothing else limits the strand count here
        file.fail(16,
                  str(h.strands, " strands of ", h.segments, " segments do not make ", h.points,
                      " points"),
                  "export it again");
    }
    file.require(h.points, sizeof(Vec3f), "points");
    std::vector<std::uint64_t> first(std::uint64_t{h.strands} + 1);
    for (std::uint64_t s = 0; s < h.strands; ++s) {
        first[s + 1] = first[s] + 1 + (segments.empty() ? h.segments : segments[s]);
    }
    if (first.back() != h.points) {
        file.fail(at, str("the strands have ", first.back(), " points, the header says ", h.points),
                  "export it again");
    }
    return first;
}

std::vector<float> read_thickness(ByteReader& file, const HairHeader& h, ProblemList& problems) {
    const std::uint64_t at = file.offset();
    std::vector<float> radius = file.array<float>(h.points, "thickness");
    for (std::size_t i = 0; i < radius.size(); ++i) {
        if (!std::isfinite(radius[i]) || radius[i] < 0.0f) {
            problems.add(
                at + 4 * i,
                str("thickness of point ", i, " is ", radius[i], ", it must be finite and >= 0"),
                "export it again");
        }
        radius[i] *= 0.5f;
    }
    return radius;
}

std::uint32_t pack_color(Vec3f c) {
    std::uint32_t packed = 0;
    for (int a = 0; a < 3; ++a) {
        const float x = std::clamp(c[a], 0.0f, 1.0f);
        packed |= static_cast<std::uint32_t>(std::lround(x * 255.0f)) << (8 * a);
    }
    return packed;
}

bool is_finite(Vec3f c) {
    return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z);
}

std::vector<std::uint32_t>
read_colors(ByteReader& file, const HairHeader& h, ProblemList& problems) {
    file.require(h.points, sizeof(Vec3f), "colours");
    std::vector<std::uint32_t> color(h.points);
    std::vector<Vec3f> part(std::min<std::size_t>(h.points, 1u << 14)); // not the whole array twice
    for (std::size_t begin = 0; begin < color.size(); begin += part.size()) {
        const std::uint64_t at = file.offset();
        const std::size_t n = std::min(part.size(), color.size() - begin);
        file.fill(std::span(part).first(n), "colours");
        for (std::size_t i = 0; i < n; ++i) {
            if (!is_finite(part[i])) {
                problems.add(at + 12 * i, str("colour of point ", begin + i, " is not finite"),
                             "export it again");
                continue;
            }
            color[begin + i] = pack_color(part[i]);
        }
    }
    return color;
}

/// Removes the strands with a single point; returns how many.
std::uint64_t drop_single_points(CurveSet& set) {
    std::uint64_t kept = 0;
    std::uint64_t to = 0;
    const std::uint64_t strands = set.curve_count();
    for (std::uint64_t s = 0; s < strands; ++s) {
        const std::uint64_t begin = set.first[s]; // first[kept] may overwrite it
        const std::uint64_t end = set.first[s + 1];
        if (end - begin < 2) continue;
        for (std::uint64_t p = begin; p < end; ++p, ++to) {
            set.points[to] = set.points[p];
            if (!set.radius.empty()) set.radius[to] = set.radius[p];
            if (!set.color.empty()) set.color[to] = set.color[p];
        }
        set.first[kept++] = to - (end - begin);
    }
    set.first.resize(kept + 1);
    set.first[kept] = to;
    set.points.resize(to);
    if (!set.radius.empty()) set.radius.resize(to);
    if (!set.color.empty()) set.color.resize(to);
    return strands - kept;
}

/// Sets the radius: the option's, else the file's thickness if it is usable, else the default for
/// hair.
void settle_radius(const HairHeader& h, const CurveReadOptions& options, Geometry& geometry) {
    CurveSet& set = geometry.curves.front();
    const bool some =
        std::any_of(set.radius.begin(), set.radius.end(), [](float r) { return r > 0; });
    const bool constant = std::isfinite(h.thickness) && h.thickness > 0.0f;
    if (options.radius > 0.0f || !(some || (set.radius.empty() && constant))) {
        settle_hair_radius(options, geometry);
    } else if (some) {
        geometry.notes.emplace_back("radius is half of the file's thickness array");
    } else {
        set.default_radius = 0.5f * h.thickness;
        geometry.notes.push_back(
            str("radius ", three_digits(set.default_radius),
                " is half of the header's default thickness; set it with --yarn-radius"));
    }
}

void settle_color(const HairHeader& h, Geometry& geometry) {
    Material& material = geometry.materials.front();
    if (h.has(kColors)) {
        material.albedo = {1.0f, 1.0f, 1.0f}; // the colours of the points are used alone
    } else if (is_finite(h.color)) {
        for (int a = 0; a < 3; ++a) material.albedo[a] = std::clamp(h.color[a], 0.0f, 1.0f);
    }
}

void note_unused(const HairHeader& h, Geometry& geometry) {
    if (h.has(kTransparency) || h.transparency > 0.0f) {
        geometry.notes.emplace_back("transparency is not used: coverage comes from thickness");
    }
    if ((h.arrays & ~std::uint32_t{kKnown}) != 0) {
        geometry.notes.push_back(str("arrays of unknown kind (bits ",
                                     h.arrays & ~std::uint32_t{kKnown}, ") are not read"));
    }
}

void check_writable(const CurveSet& set) {
    const auto refuse = [](const std::string& what, const char* fix) {
        throw Error(ErrorCode::InvalidArgument, what, fix);
    };
    if (set.curve_count() == 0) refuse("there are no strands to write to a .hair file", "");
    if (set.basis != Basis::Linear) {
        refuse("a .hair file holds polylines, these curves are cubic", "write a .bcc file");
    }
    constexpr std::uint64_t kMax32 = std::numeric_limits<std::uint32_t>::max();
    if (set.points.size() > kMax32) {
        refuse(str("a .hair file holds at most ", kMax32, " points, these are ", set.points.size()),
               "write several files");
    }
    for (std::size_t s = 0; s < set.curve_count(); ++s) {
        const std::uint64_t n = set.first[s + 1] - set.first[s];
        if (set.is_closed(s)) refuse(str("strand ", s, " is closed"), "write a .bcc file");
        if (n < 2 || n > 65536) {
            refuse(str("strand ", s, " has ", n, " points, a .hair file takes 2 to 65536"),
                   "split it");
        }
    }
}

bool all_same_length(const CurveSet& set) {
    for (std::size_t s = 1; s < set.curve_count(); ++s) {
        if (set.first[s + 1] - set.first[s] != set.first[1]) return false;
    }
    return true;
}

void write_header(OutputFile& file, const CurveSet& set, bool segments, Vec3f color) {
    std::uint32_t arrays = kPoints;
    if (segments) arrays |= kSegments;
    if (!set.radius.empty()) arrays |= kThickness;
    if (!set.color.empty()) arrays |= kColors;
    file.write("HAIR", 4);
    file.write_value(static_cast<std::uint32_t>(set.curve_count()));
    file.write_value(static_cast<std::uint32_t>(set.points.size()));
    file.write_value(arrays);
    file.write_value(static_cast<std::uint32_t>(segments ? 0 : set.first[1] - 1));
    file.write_value(2.0f * set.default_radius);
    file.write_value(0.0f); // opaque
    for (int a = 0; a < 3; ++a) file.write_value(color[a]);
    constexpr std::array<char, kInfoBytes> kInfo{"Heddle"};
    file.write_array(std::span<const char>(kInfo));
}

} // namespace

Geometry read_hair(const std::string& path, const CurveReadOptions& options) {
    check_options(options);
    ByteReader file(path);
    const HairHeader header = read_header(file);

    CurveSet set;
    set.basis = Basis::Linear;
    set.first = read_offsets(file, header);
    const std::uint64_t points_at = file.offset();
    set.points = file.array<Vec3f>(header.points, "points");
    ProblemList problems;
    for (std::size_t s = 0; s < set.curve_count(); ++s) {
        check_finite(std::span(set.points).subspan(set.first[s], set.first[s + 1] - set.first[s]),
                     s, points_at + 12 * set.first[s], problems);
    }
    if (header.has(kThickness)) set.radius = read_thickness(file, header, problems);
    if (header.has(kTransparency)) file.skip(header.points, 4, "transparency");
    if (header.has(kColors)) set.color = read_colors(file, header, problems);
    problems.throw_if_any(path);
    const std::uint64_t dropped = drop_single_points(set);
    if (set.curve_count() == 0) {
        file.fail(16, str("none of its ", header.strands, " strands has 2 points or more"),
                  "export it again");
    }

    Geometry geometry = make_curve_geometry(std::move(set), path, "hair");
    if (dropped > 0) {
        geometry.notes.push_back(
            str(dropped, " of ", header.strands, " strands have one point and are dropped"));
    }
    note_unused(header, geometry);
    note_trailing_bytes(file, geometry);
    settle_radius(header, options, geometry);
    settle_color(header, geometry);
    return geometry;
}

void write_hair(const CurveSet& set, const std::string& path, Vec3f color) {
    check_writable(set);
    const bool segments = !all_same_length(set);
    OutputFile file(path);
    write_header(file, set, segments, color);
    if (segments) {
        for (std::size_t s = 0; s < set.curve_count(); ++s) {
            file.write_value(static_cast<std::uint16_t>(set.first[s + 1] - set.first[s] - 1));
        }
    }
    file.write_array(std::span<const Vec3f>(set.points));
    for (const float r : set.radius) file.write_value(2.0f * r);
    for (const std::uint32_t c : set.color) {
        for (int a = 0; a < 3; ++a) {
            file.write_value(static_cast<float>((c >> (8 * a)) & 0xffu) / 255.0f);
        }
    }
    file.commit();
}

} // namespace heddle
