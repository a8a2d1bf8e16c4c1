#include <heddle/base/error.h>
#include <heddle/io/curve/curve_checks.h>
#include <heddle/io/curve/curve_files.h>
#include <heddle/io/file/output_file.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace heddle {
namespace {

constexpr std::uint64_t kHeaderBytes = 64;
constexpr std::uint64_t kInfoBytes = 40;

struct BccHeader {
    Basis basis = Basis::CatmullRom;
    std::uint8_t up_axis = 0;
    std::uint64_t curves = 0;
    std::uint64_t points = 0;
};

struct BasisName {
    const char* name;
    Basis basis;
};
constexpr std::array<BasisName, 3> kBasisNames{
    {{"C0", Basis::CatmullRom}, {"BS", Basis::CubicBSpline}, {"PL", Basis::Linear}}};

Basis parse_basis(const std::string& type, const ByteReader& file) {
    for (const BasisName& b : kBasisNames) {
        if (type == b.name) return b.basis;
    }
    std::string shown = type;
    for (char& c : shown) c = c >= ' ' && c <= '~' ? c : '?';
    file.fail(4, str("curve type '", shown, "' is not known"),
              "known: 'C0' uniform Catmull-Rom, 'BS' cubic B-spline, 'PL' polyline");
}

BccHeader read_header(ByteReader& file) {
    if (file.remaining() < 4 || file.text(3, "magic") != "BCC") {
        file.fail(0, "is not a .bcc file: it does not start with 'BCC'", "check the file's kind");
    }
    if (const int sizes = file.u8("number sizes"); sizes != 0x44) {
        file.fail(3, str("number sizes are 0x", std::hex, sizes, ", only 0x44 (4 bytes) is known"),
                  "export it with 32-bit numbers");
    }
    BccHeader h;
    h.basis = parse_basis(file.text(2, "curve type"), file);
    if (const int dimensions = file.u8("dimensions"); dimensions != 3) {
        file.fail(6, str("points have ", dimensions, " dimensions, they must have 3"),
                  "export it in 3 dimensions");
    }
    h.up_axis = file.u8("up axis");
    h.curves = file.u64("curve count");
    h.points = file.u64("point count");
    file.skip(1, kInfoBytes, "info"); // text in the format's definition, garbage in some files
    if (h.curves == 0 || h.points == 0) {
        file.fail(h.curves == 0 ? 8 : 16, str("holds no ", h.curves == 0 ? "curves" : "points"),
                  "export it again");
    }
    file.require(h.curves, 4, "curves");
    file.require(h.points, 12, "points");
    return h;
}

/// Appends the points of one curve to the set; the header's total is never exceeded.
void read_curve(ByteReader& file, std::uint64_t curve, CurveSet& set, ProblemList& problems) {
    const std::uint64_t at = file.offset();
    const std::int64_t signed_count = file.i32("point count of a curve");
    const bool closed = signed_count < 0;
    const auto count = static_cast<std::uint64_t>(closed ? -signed_count : signed_count);
    const std::uint64_t begin = set.first.back();
    if (count > set.points.size() - begin) {
        file.fail(at,
                  str("curve ", curve, " has ", count, " points, the header's ", set.points.size(),
                      " points leave it ", set.points.size() - begin),
                  "export it again");
    }
    check_point_count(set.basis, closed, curve, count, at, problems);
    const std::span<Vec3f> points = std::span(set.points).subspan(begin, count);
    const std::uint64_t points_at = file.offset();
    file.fill(points, "points of a curve");
    check_finite(points, curve, points_at, problems);
    set.closed.push_back(closed ? 1 : 0);
    set.first.push_back(begin + count);
}

/// Opens the cubic curves whose closing span is an error of the file, and returns how many.
///
/// Two of the 22 yarns of Yuksel's tea_cozy.bcc are marked closed although their ends are on
/// opposite sides of the cozy, 100 times their longest step apart; if drawn as marked, they cross
/// it as taut strings. An otherwise uniform cubic has no such step; a polyline may have one and is
/// not changed.
std::uint64_t open_false_closures(CurveSet& set) {
    constexpr float kFarthest = 16.0f; // times the longest step; true closures have at most 1.1
    if (set.basis == Basis::Linear) return 0;
    std::uint64_t opened = 0;
    for (std::size_t c = 0; c < set.curve_count(); ++c) {
        const std::uint64_t n = set.first[c + 1] - set.first[c];
        if (!set.is_closed(c) || n < min_point_count(set.basis, false)) continue;
        const std::span<const Vec3f> p = std::span(set.points).subspan(set.first[c], n);
        float longest = 0.0f;
        for (std::size_t i = 1; i < n; ++i) longest = std::max(longest, length(p[i] - p[i - 1]));
        if (length(p.front() - p.back()) <= kFarthest * longest) continue;
        set.closed[c] = 0;
        ++opened;
    }
    return opened;
}

std::string describe_up_axis(std::uint8_t axis) {
    if (axis > 2)
        return str("up axis ", int{axis}, " is not known; coordinates are as in the file");
    return str("up axis is ", "xyz"[axis], "; coordinates are as in the file");
}

[[noreturn]] void refuse(const std::string& what) {
    throw Error(ErrorCode::InvalidArgument, what);
}

void check_writable(const CurveSet& set) {
    for (std::size_t c = 0; c < set.curve_count(); ++c) {
        const std::uint64_t n = set.first[c + 1] - set.first[c];
        const std::uint64_t least = min_point_count(set.basis, set.is_closed(c));
        constexpr std::uint64_t kMax = std::numeric_limits<std::int32_t>::max();
        if (n < least || n > kMax) {
            refuse(str("curve ", c, " has ", n, " points, a .bcc file of its kind takes ", least,
                       " to ", kMax));
        }
    }
}

/// The counts of the header for sets that can be stored in one file.
BccHeader header_of(std::span<const CurveSet> sets) {
    BccHeader header;
    for (const CurveSet& set : sets) {
        if (set.curve_count() == 0) continue;
        check_writable(set);
        if (header.curves > 0 && set.basis != header.basis)
            refuse("the curves have several bases, a .bcc file has one");
        header.basis = set.basis;
        header.curves += set.curve_count();
        header.points += set.points.size();
    }
    if (header.curves == 0) refuse("there are no curves to write to a .bcc file");
    return header;
}

void write_curves(const CurveSet& set, OutputFile& file) {
    for (std::size_t c = 0; c < set.curve_count(); ++c) {
        const auto points =
            std::span(set.points).subspan(set.first[c], set.first[c + 1] - set.first[c]);
        const auto n = static_cast<std::int32_t>(points.size());
        file.write_value(set.is_closed(c) ? -n : n);
        file.write_array(std::span<const Vec3f>(points));
    }
}

} // namespace

Geometry read_bcc(const std::string& path, const CurveReadOptions& options) {
    check_options(options);
    ByteReader file(path);
    const BccHeader header = read_header(file);

    CurveSet set;
    set.basis = header.basis;
    set.points.resize(header.points);
    set.first.reserve(header.curves + 1);
    set.first.push_back(0);
    set.closed.reserve(header.curves);
    ProblemList problems;
    for (std::uint64_t c = 0; c < header.curves; ++c) read_curve(file, c, set, problems);
    if (set.first.back() != header.points) {
        problems.add(
            16, str("header says ", header.points, " points, the curves hold ", set.first.back()),
            "export it again");
    }
    problems.throw_if_any(path);
    const std::uint64_t opened = open_false_closures(set);
    if (std::none_of(set.closed.begin(), set.closed.end(), [](auto c) { return c != 0; })) {
        set.closed.clear();
    }

    Geometry geometry = make_curve_geometry(std::move(set), path, "yarn");
    geometry.notes.push_back(describe_up_axis(header.up_axis));
    if (opened > 0) {
        geometry.notes.push_back(
            str(opened, opened == 1 ? " curve is" : " curves are",
                " marked closed but have ends more than 16 longest steps apart; read as open"));
    }
    note_trailing_bytes(file, geometry);
    settle_yarn_radius(options, geometry);
    return geometry;
}

void write_bcc(std::span<const CurveSet> sets, const std::string& path, int up_axis) {
    const BccHeader header = header_of(sets);
    if (up_axis < 0 || up_axis > 2) {
        throw Error(ErrorCode::InvalidArgument, str("up axis is ", up_axis, ", it must be 0 to 2"));
    }
    OutputFile file(path);
    file.write("BCC\x44", 4);
    for (const BasisName& b : kBasisNames) {
        if (b.basis == header.basis) file.write(b.name, 2);
    }
    file.write_value(std::uint8_t{3});
    file.write_value(static_cast<std::uint8_t>(up_axis));
    file.write_value<std::uint64_t>(header.curves);
    file.write_value<std::uint64_t>(header.points);
    constexpr std::array<char, kInfoBytes> kInfo{"Heddle"};
    file.write_array(std::span<const char>(kInfo));
    static_assert(4 + 2 + 1 + 1 + 8 + 8 + kInfoBytes == kHeaderBytes);
    for (const CurveSet& set : sets) write_curves(set, file);
    file.commit();
}

void write_bcc(const CurveSet& set, const std::string& path, int up_axis) {
    write_bcc(std::span(&set, 1), path, up_axis);
}

} // namespace heddle
