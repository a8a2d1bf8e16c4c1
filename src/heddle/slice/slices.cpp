#include <heddle/slice/slices.h>

#include <heddle/base/error.h>
#include <heddle/slice/slice_glsl.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace heddle::slice {
namespace {

constexpr double kMaxSlices = 4294967295.0; ///< slices are numbered by 32 bits
constexpr double kMaxOfSpan = 1.0e6;        ///< this and the next: as in kCourseGlsl
constexpr std::uint32_t kSpansAtOnce = 16384;

/// As in kCurveGlsl.
struct CurveRow {
    std::uint32_t first_point, points, spans, flags;
    std::uint32_t first_knot, layer, pad0, pad1;
    float twist, model_radius, extent, fiber_radius;
    float yarn_radius, spacing, pad2, pad3;
};
static_assert(sizeof(CurveRow) == 64);

struct CourseRow {
    double length, turns, slices, most;
};

struct PointRow {
    Vec3f at;
    float radius;
};

/// The tables that are uploaded: all curves as one list.
struct CurveTables {
    std::vector<PointRow> points;
    std::vector<std::uint32_t> colors;
    std::vector<CurveRow> curves;
    std::vector<std::uint32_t> materials; ///< by curve
    std::size_t knots = 0;
};

std::uint32_t flags_of(const CurveSet& set, std::size_t curve) {
    return (set.is_closed(curve) ? 1u : 0u) | (set.basis == Basis::Linear ? 2u : 0u) |
           (set.basis == Basis::CubicBSpline ? 4u : 0u) | (set.color.empty() ? 0u : 8u);
}

/// @param lattice  rays follow segments on the lattice: long segments would fill most of a block
float spacing_of(double radius_units, double asked, bool lattice) {
    constexpr double kMaxOnLattice = 16.0;
    if (asked > 0.0) return static_cast<float>(asked);
    const double half = std::max(0.5 * radius_units, 1.0);
    return static_cast<float>(lattice ? std::min(half, kMaxOnLattice) : half);
}

/// Radians per subvoxel: a lattice does not resolve more.
constexpr double kMaxTwist = 3.141592653589793;

void check_twist(const YarnType& yarn, double radius_units) {
    if (yarn.model != YarnModel::Slice || !(radius_units > 0.0)) return;
    const double model = static_cast<double>(yarn.model_radius) / radius_units;
    const double twist = std::abs(static_cast<double>(yarn.twist)) * model;
    if (twist <= kMaxTwist) return;
    throw Error(
        ErrorCode::InvalidArgument,
        str("raster: '", yarn.name, "' twists by ", twist, " radians in a subvoxel (limit 3.14)"),
        "use smaller voxels, or a smaller twist");
}

/// The radius of a curve at its start, scene units.
double head_radius(const CurveSet& set, const YarnType* yarn, std::size_t curve) {
    const float fixed = yarn == nullptr ? 0.0f : yarn->radius;
    return static_cast<double>(fixed > 0.0f ? fixed : set.radius_at(set.first[curve]));
}

void add_set(CurveTables& out,
             const Geometry& geometry,
             std::size_t s,
             const SectionLayers& sections,
             const LatticeUnits& units,
             const PlaceOptions& options) {
    const CurveSet& set = geometry.curves[s];
    const YarnType* yarn = geometry.yarn_of(set);
    const Vec3d corner{options.origin.x * units.voxel_size.x, options.origin.y * units.voxel_size.y,
                       options.origin.z * units.voxel_size.z};
    const double inv = 1.0 / units.unit;
    const auto base = static_cast<std::uint32_t>(out.points.size());
    for (std::size_t i = 0; i < set.points.size(); ++i) {
        const double radius = static_cast<double>(set.radius_at(i)) * inv;
        out.points.push_back(
            {to_float((to_double(set.points[i]) - corner) * inv), static_cast<float>(radius)});
    }
    if (!set.color.empty()) {
        out.colors.resize(base, 0xffffffu);
        out.colors.insert(out.colors.end(), set.color.begin(), set.color.end());
    }
    for (std::size_t c = 0; c < set.curve_count(); ++c) {
        const SectionLayer& layer = sections.layers[sections.of(s, c)];
        const float fixed = yarn == nullptr ? 0.0f : yarn->radius;
        const double radius = inv * head_radius(set, yarn, c);
        if (yarn != nullptr && options.lattice) check_twist(*yarn, radius);
        CurveRow row{};
        row.first_point = base + static_cast<std::uint32_t>(set.first[c]);
        row.points = static_cast<std::uint32_t>(set.first[c + 1] - set.first[c]);
        row.spans = static_cast<std::uint32_t>(set.span_count(c));
        row.flags = flags_of(set, c);
        row.first_knot = static_cast<std::uint32_t>(out.knots);
        row.layer = sections.of(s, c);
        row.twist = yarn != nullptr && yarn->model == YarnModel::Slice ? yarn->twist : 0.0f;
        row.model_radius = yarn == nullptr ? 1.0f : yarn->model_radius;
        row.extent = layer.extent;
        row.fiber_radius = layer.fiber_radius;
        row.yarn_radius = static_cast<float>(static_cast<double>(fixed) * inv);
        row.spacing = spacing_of(radius, options.spacing, options.lattice);
        out.knots += row.spans + 1;
        out.curves.push_back(row);
        out.materials.push_back(set.material);
    }
}

/// The curves [first, end) of a chunk, and its number of slices.
struct CurveRun {
    std::size_t first = 0, end = 0;
    std::uint64_t slices = 0;
    std::uint64_t segments = 0;
};

std::vector<CurveRun>
split_runs(const CurveTables& tables, const std::vector<CourseRow>& courses, std::uint64_t most) {
    std::vector<CurveRun> runs;
    for (std::size_t c = 0; c < courses.size(); ++c) {
        const auto count = static_cast<std::uint64_t>(courses[c].slices);
        if (count > most) {
            throw Error(ErrorCode::OutOfMemory,
                        str("raster: one yarn needs ", count, " slices (limit ", most,
                            " of the driver's buffers)"),
                        "give more --memory, larger voxels or a smaller twist");
        }
        const bool same = !runs.empty() && tables.materials[c] == tables.materials[c - 1];
        if (!same || runs.back().slices + count > most) runs.push_back({.first = c, .end = c});
        runs.back().end = c + 1;
        runs.back().slices += count;
        runs.back().segments += count > 0 ? count - 1 : 0;
    }
    return runs;
}

void check_count(const std::vector<CourseRow>& courses, double most) {
    double total = 0.0;
    for (const CourseRow& c : courses) {
        total += c.slices;
        if (c.most <= kMaxOfSpan) continue;
        throw Error(ErrorCode::InvalidArgument,
                    str("raster: ", c.most, " slices between two points of a yarn (limit 10^6)"),
                    "use a smaller twist, or more points");
    }
    const double limit = most > 0.0 ? most : kMaxSlices;
    if (total <= limit) return;
    throw Error(ErrorCode::InvalidArgument,
                str("raster: the yarns need ", total, " slices (limit ", limit, ")"),
                "use larger voxels, a smaller twist, or --backend sample");
}

/// The most spans of a curve, at least 1.
std::uint32_t most_spans(const std::vector<CurveRow>& curves) {
    std::uint32_t most = 1;
    for (const CurveRow& c : curves) most = std::max(most, c.spans);
    return most;
}

template <typename T>
opengl::Buffer upload(const char* name, const std::vector<T>& rows) {
    return {name, std::span<const T>(rows)};
}

std::string shared_text() {
    return std::string(kSliceGlsl) + std::string(kCurveGlsl);
}

} // namespace

PlacePrograms::PlacePrograms()
    : measure(opengl::Program::compute("measure yarns", shared_text(), kCourseGlsl)),
      place(opengl::Program::compute("place slices", shared_text(), kPlaceGlsl)) {}

std::int64_t
estimate_slices(const Geometry& geometry, const LatticeUnits& units, const PlaceOptions& options) {
    constexpr double kMaxTurn = 0.4; // as in kCourseGlsl
    double count = 0.0;
    for (const CurveSet& set : geometry.curves) {
        const YarnType* yarn = geometry.yarn_of(set);
        for (std::size_t c = 0; c < set.curve_count(); ++c) {
            const double radius = head_radius(set, yarn, c) / units.unit;
            double least =
                1.0 / static_cast<double>(spacing_of(radius, options.spacing, options.lattice));
            if (yarn != nullptr && yarn->model == YarnModel::Slice && radius > 0.0) {
                const double turn =
                    std::fabs(static_cast<double>(yarn->twist * yarn->model_radius));
                least = std::max(least, turn / radius / kMaxTurn);
            }
            for (std::size_t p = set.first[c]; p + 1 < set.first[c + 1]; ++p) {
                const double chord = length(to_double(set.points[p + 1] - set.points[p]));
                count += std::ceil(chord / units.unit * least);
            }
        }
    }
    return static_cast<std::int64_t>(std::min(count, 1.0e18));
}

std::vector<SliceChunk> place_slices(const opengl::Context& context,
                                     const Geometry& geometry,
                                     const SectionLayers& sections,
                                     const LatticeUnits& units,
                                     const PlaceOptions& options) {
    CurveTables tables;
    for (std::size_t s = 0; s < geometry.curves.size(); ++s) {
        add_set(tables, geometry, s, sections, units, options);
    }
    const opengl::Buffer points = upload("control points", tables.points);
    const opengl::Buffer colors = upload("colours", tables.colors);
    const opengl::Buffer curves = upload("curves", tables.curves);
    const opengl::Buffer course("lengths of yarns", tables.curves.size() * sizeof(CourseRow));
    const opengl::Buffer lengths("lengths at nodes", tables.knots * sizeof(double));
    const opengl::Buffer frames("frames at nodes", tables.knots * 4 * sizeof(float));
    const opengl::Buffer* bound[] = {&points, &colors, &curves, &course, &lengths, &frames};
    for (std::uint32_t b = 0; b < 6; ++b) bound[b]->bind_storage(b);

    std::optional<PlacePrograms> own;
    if (options.programs == nullptr) own.emplace();
    const auto& [measure, place] = own ? *own : *options.programs;
    const auto count = static_cast<std::uint32_t>(tables.curves.size());
    measure.set("curve_count", count);
    for (std::uint32_t span = 0; span < most_spans(tables.curves); span += kSpansAtOnce) {
        measure.set("first_span", span);
        measure.dispatch(count);
        opengl::finish_writes();
    }
    std::vector<CourseRow> courses(count);
    course.read(std::as_writable_bytes(std::span(courses)));
    context.check("measure yarns");
    check_count(courses, options.most_slices);

    std::vector<std::uint32_t> first(1, 0);
    for (const CourseRow& c : courses) {
        first.push_back(first.back() + static_cast<std::uint32_t>(c.slices));
    }
    const opengl::Buffer firsts = upload("numbers of slices", first);
    firsts.bind_storage(6);
    std::vector<SliceChunk> out;
    std::int64_t bytes = context.limits().storage_bytes;
    if (options.chunk_bytes > 0) bytes = std::min(bytes, options.chunk_bytes);
    const auto most = static_cast<std::uint64_t>(bytes) / sizeof(PlacedSlice);
    for (const CurveRun& run : split_runs(tables, courses, most)) {
        if (run.slices == 0) continue;
        SliceChunk chunk{.slices = opengl::Buffer("slices", run.slices * sizeof(PlacedSlice)),
                         .count = static_cast<std::uint32_t>(run.slices),
                         .segments = static_cast<std::uint32_t>(run.segments),
                         .first = first[run.first],
                         .material = tables.materials[run.first]};
        chunk.slices.bind_storage(7);
        place.set("first_curve", static_cast<std::uint32_t>(run.first));
        place.set("curve_count", static_cast<std::uint32_t>(run.end - run.first));
        place.dispatch(run.slices);
        out.push_back(std::move(chunk));
    }
    opengl::finish_writes();
    context.check("place slices");
    return out;
}

std::vector<PlacedSlice> read_slices(const SliceChunk& chunk) {
    std::vector<PlacedSlice> out(chunk.count);
    chunk.slices.read(std::as_writable_bytes(std::span(out)));
    return out;
}

} // namespace heddle::slice
