#include <heddle/geom/generate.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/geom/generate_parts.h>

#include <array>
#include <cmath>

namespace heddle {
namespace {

/// The defaults of a kind, and the smallest values that make sense.
struct KindInfo {
    GenerateKind kind;
    std::string_view name;
    std::int64_t nx, ny;
    std::int64_t least_ny;
    double radius;        ///< scene units
    double spacing;       ///< in radii
    double least_spacing; ///< in radii; yarns closer than this intersect
    bool cloth;
};

// The yarn radius is that of published yarn-level garments, about 0.1; hair is in centimetres.
constexpr double kTight = generate_parts::kTightestWale;
constexpr double kJam = generate_parts::kJammedWeave;
constexpr std::array<KindInfo, 10> kKinds{{
    {GenerateKind::Knit, "knit", 20, 24, 1, 0.1, 8.4, kTight, true},
    {GenerateKind::Rib, "rib", 20, 24, 1, 0.1, 8.4, kTight, true},
    {GenerateKind::Cable, "cable", 20, 32, 1, 0.1, 8.4, kTight, true},
    {GenerateKind::Plain, "plain", 40, 40, 1, 0.1, 4.0, kJam, true},
    {GenerateKind::Twill, "twill", 40, 40, 1, 0.1, 4.0, kJam, true},
    {GenerateKind::Satin, "satin", 40, 40, 1, 0.1, 3.6, kJam, true},
    {GenerateKind::Hair, "hair", 4096, 32, 2, 0.004, 8.0, 0.0, false},
    {GenerateKind::Curls, "curls", 4096, 128, 2, 0.004, 8.0, 0.0, false},
    {GenerateKind::Brushed, "brushed", 1024, 1024, 1, 1.0, 0.01, 0.0, false},
    {GenerateKind::Grass, "grass", 2000, 6, 1, 0.05, 3.0, 0.0, false},
}};

const KindInfo& info(GenerateKind kind) {
    for (const KindInfo& k : kKinds) {
        if (k.kind == kind) return k;
    }
    throw Error(ErrorCode::InvalidArgument,
                str("kind ", static_cast<int>(kind), " is none of the ", kKinds.size(), " kinds"));
}

/// Stitches, crossings, points, texels or quads: even 20 points each are easily counted in 64 bits.
constexpr double kMaxCells = 0x1p36;
/// Texels along an axis: more than image files and glTF viewers accept.
constexpr std::int64_t kMaxTexels = 65536;
/// Vertices of a mesh: its triangles have 32-bit indices.
constexpr double kMaxVertices = 0x1p32;

void check_count(const KindInfo& kind, const char* name, std::int64_t n, std::int64_t least) {
    const std::int64_t most = kind.kind == GenerateKind::Brushed ? kMaxTexels : 1LL << 36;
    if (n < least || n > most) {
        throw Error(
            ErrorCode::InvalidArgument,
            str(kind.name, ": ", name, " is ", n, ", it must be from ", least, " to ", most),
            "or 0 for the default");
    }
}

void check_length(const KindInfo& kind, const char* name, double length, double least) {
    // the tolerance of 1e-6 is for a minimum spacing that was given as rounded decimals
    if (!(length > 0.0 && length <= 1e12) || length < least * (1.0 - 1e-6)) {
        throw Error(ErrorCode::InvalidArgument,
                    str(kind.name, ": ", name, " is ", length, ", it must be above 0",
                        least > 0.0 ? str(" and at least ", least, ", else yarns intersect") : "",
                        ", and at most 1e12"),
                    "or 0 for the default");
    }
}

void check_total(const KindInfo& kind, const GenerateOptions& o) {
    const double cells = static_cast<double>(o.nx) * static_cast<double>(o.ny);
    const bool grass = kind.kind == GenerateKind::Grass;
    const double vertices = 2.0 * static_cast<double>(o.nx) * (static_cast<double>(o.ny) + 1.0);
    if (cells > kMaxCells || (grass && vertices > kMaxVertices)) {
        throw Error(ErrorCode::InvalidArgument,
                    grass ? str(kind.name, ": nx ", o.nx, " by ny ", o.ny, " makes ", vertices,
                                " vertices, a mesh holds 2^32")
                          : str(kind.name, ": nx ", o.nx, " by ny ", o.ny, " is more than 2^36"),
                    "use smaller counts");
    }
}

std::int64_t bytes_of(const generate_parts::Sizes& size) {
    std::int64_t bytes = size.texel_bytes;
    for (std::size_t s = 0; s < size.curves.size(); ++s) {
        const std::int64_t points = size.curves[s] * size.per_curve[s];
        bytes += points * static_cast<std::int64_t>(sizeof(Vec3f));
        if (size.point_radius) bytes += points * static_cast<std::int64_t>(sizeof(float));
        bytes += (size.curves[s] + 1) * static_cast<std::int64_t>(sizeof(std::uint64_t));
    }
    const std::size_t vertex =
        2 * sizeof(Vec3f) + sizeof(Uv) + (size.tangents ? sizeof(Tangent) : 0);
    bytes += size.vertices * static_cast<std::int64_t>(vertex);
    bytes += size.triangles * static_cast<std::int64_t>(sizeof(std::array<std::uint32_t, 3>));
    return bytes;
}

} // namespace

namespace generate_parts {

Sizes sizes(const GenerateOptions& o) {
    Sizes s;
    switch (o.kind) {
    case GenerateKind::Knit:
    case GenerateKind::Rib:
    case GenerateKind::Cable:
        s.curves = {o.ny};
        s.per_curve = {o.nx * kStitchPoints + 3}; // the last point and two end points
        break;
    case GenerateKind::Plain:
    case GenerateKind::Twill:
    case GenerateKind::Satin:
        s.curves = {o.nx, o.ny};
        s.per_curve = {o.ny * kCrossingPoints + 3, o.nx * kCrossingPoints + 3};
        break;
    case GenerateKind::Hair:
    case GenerateKind::Curls:
        s.curves = {o.nx};
        s.per_curve = {o.ny};
        s.point_radius = true;
        break;
    case GenerateKind::Brushed: {
        const std::int64_t across = (o.nx + kQuadTexels - 1) / kQuadTexels;
        const std::int64_t down = (o.ny + kQuadTexels - 1) / kQuadTexels;
        s.vertices = (across + 1) * (down + 1);
        s.triangles = 2 * across * down;
        s.tangents = true;
        s.texel_bytes = 2 * 3 * o.nx * o.ny; // the anisotropy and the roughness texture, RGB
        break;
    }
    case GenerateKind::Grass:
        s.vertices = 2 * o.nx * (o.ny + 1);
        s.triangles = 2 * o.nx * o.ny;
        s.texel_bytes = std::int64_t{4} * kLeafShapes * kLeafWidth * kLeafHeight;
        break;
    }
    return s;
}

CurveSet make_empty_curves(std::int64_t curves, std::int64_t points_per_curve, Basis basis) {
    const auto per_curve = static_cast<std::size_t>(points_per_curve);
    CurveSet set;
    set.basis = basis;
    set.first.resize(static_cast<std::size_t>(curves) + 1);
    for (std::size_t c = 0; c < set.first.size(); ++c) set.first[c] = c * per_curve;
    set.points.resize(static_cast<std::size_t>(curves) * per_curve);
    return set;
}

CurveSet make_curves(std::int64_t curves,
                     std::int64_t points_per_curve,
                     Basis basis,
                     FunctionRef<Vec3d(std::int64_t, std::int64_t)> point_at) {
    const auto per_curve = static_cast<std::size_t>(points_per_curve);
    CurveSet set = make_empty_curves(curves, points_per_curve, basis);
    // in parallel over points, not curves: a few very long yarns also keep all threads busy
    parallel_chunks(set.points.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            set.points[i] = to_float(point_at(static_cast<std::int64_t>(i / per_curve),
                                              static_cast<std::int64_t>(i % per_curve)));
        }
    });
    return set;
}

} // namespace generate_parts

std::string_view to_string(GenerateKind kind) {
    return info(kind).name;
}

std::optional<GenerateKind> generate_kind_from(std::string_view name) {
    for (const KindInfo& k : kKinds) {
        if (k.name == name) return k.kind;
    }
    return std::nullopt;
}

GenerateOptions resolve(const GenerateOptions& options) {
    const KindInfo& kind = info(options.kind);
    GenerateOptions o = options;
    if (o.nx == 0) o.nx = kind.nx;
    if (o.ny == 0) o.ny = kind.ny;
    if (o.radius == 0.0) o.radius = kind.radius;
    check_count(kind, "nx", o.nx, 1);
    check_count(kind, "ny", o.ny, kind.least_ny);
    check_total(kind, o);
    check_length(kind, "radius", o.radius, 0.0);
    if (o.spacing == 0.0) o.spacing = kind.spacing * o.radius;
    check_length(kind, "spacing", o.spacing, kind.least_spacing * o.radius);
    if (!kind.cloth && o.shape != GenerateShape::Flat) {
        throw Error(ErrorCode::InvalidArgument,
                    str(kind.name, ": only cloth can be folded or hung"), "use the shape 'flat'");
    }
    return o;
}

std::int64_t predict_nodes(const GenerateOptions& options) {
    const generate_parts::Sizes size = generate_parts::sizes(resolve(options));
    std::int64_t nodes = size.vertices;
    for (std::size_t s = 0; s < size.curves.size(); ++s) {
        nodes += size.curves[s] * size.per_curve[s];
    }
    return nodes;
}

std::int64_t predict_bytes(const GenerateOptions& options) {
    return bytes_of(generate_parts::sizes(resolve(options)));
}

Geometry generate(const GenerateOptions& options) {
    const GenerateOptions o = resolve(options);
    Geometry geometry;
    switch (o.kind) {
    case GenerateKind::Knit:
    case GenerateKind::Rib:
    case GenerateKind::Cable: geometry = generate_parts::generate_knit(o); break;
    case GenerateKind::Plain:
    case GenerateKind::Twill:
    case GenerateKind::Satin: geometry = generate_parts::generate_weave(o); break;
    case GenerateKind::Hair:
    case GenerateKind::Curls: geometry = generate_parts::generate_hair(o); break;
    case GenerateKind::Brushed: geometry = generate_parts::generate_brushed(o); break;
    case GenerateKind::Grass: geometry = generate_parts::generate_grass(o); break;
    }
    geometry.name = to_string(o.kind);
    return geometry;
}

} // namespace heddle
