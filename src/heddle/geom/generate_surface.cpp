#include <heddle/base/parallel.h>
#include <heddle/base/random.h>
#include <heddle/geom/generate_parts.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace heddle::generate_parts {
namespace {

constexpr double kPi = std::numbers::pi;

std::uint8_t to_byte(double unit) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(unit, 0.0, 1.0) * 255.0));
}

/// Scratches: noise in [-1, 1] that runs along x, smooth over `reach` texels; rows differ.
double streak(std::uint64_t seed, std::int64_t x, std::int64_t row, double reach) {
    const auto r = static_cast<std::uint64_t>(row);
    const double start = static_cast<double>(to_unit_float(hash64(seed, r, ~0ULL)));
    const double at = static_cast<double>(x) / reach + start;
    const auto cell = static_cast<std::uint64_t>(at);
    const double f = at - std::floor(at);
    const double a = static_cast<double>(to_unit_float(hash64(seed, r, cell)));
    const double b = static_cast<double>(to_unit_float(hash64(seed, r, cell + 1)));
    return 2.0 * (a + (b - a) * f * f * (3.0 - 2.0 * f)) - 1.0;
}

/// Long scratches one texel wide, shorter ones, and broad bands; in [-1, 1].
double brushing(std::uint64_t seed, std::int64_t x, std::int64_t y) {
    return 0.5 * streak(seed, x, y, 300.0) + 0.3 * streak(seed + 1, x, y, 60.0) +
           0.2 * streak(seed + 2, x, y / 6, 500.0);
}

/// Fills an RGB texture row by row on all threads with `texel(x, y, rgb)`.
Texture make_texture(const char* name,
                     const GenerateOptions& o,
                     FunctionRef<void(std::int64_t, std::int64_t, std::uint8_t*)> texel) {
    Texture t;
    t.name = name;
    t.width = static_cast<std::int32_t>(o.nx);
    t.height = static_cast<std::int32_t>(o.ny);
    t.channels = 3;
    t.texels.resize(3 * static_cast<std::size_t>(o.nx) * static_cast<std::size_t>(o.ny));
    parallel_chunks(t.texels.size() / 3, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto n = static_cast<std::int64_t>(i);
            texel(n % o.nx, n / o.nx, &t.texels[3 * i]);
        }
    });
    return t;
}

/// A flat grid of quads in the xy plane that faces +z; texture rows run from +y down.
Mesh make_plate(const GenerateOptions& o) {
    const std::int64_t across = (o.nx + kQuadTexels - 1) / kQuadTexels;
    const std::int64_t down = (o.ny + kQuadTexels - 1) / kQuadTexels;
    const Sizes size = sizes(o);
    const auto vertices = static_cast<std::size_t>(size.vertices);
    Mesh mesh;
    mesh.positions.resize(vertices);
    mesh.uvs.resize(vertices);
    mesh.normals.assign(vertices, {0.0f, 0.0f, 1.0f});
    mesh.tangents.assign(vertices, {1.0f, 0.0f, 0.0f, 1.0f});
    mesh.triangles.resize(static_cast<std::size_t>(size.triangles));
    parallel_chunks(vertices, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto n = static_cast<std::int64_t>(i);
            const std::int64_t column = n % (across + 1);
            const std::int64_t row = n / (across + 1);
            const double u = static_cast<double>(column) / static_cast<double>(across);
            const double v = static_cast<double>(row) / static_cast<double>(down);
            mesh.positions[i] = to_float({u * static_cast<double>(o.nx) * o.spacing,
                                          (1.0 - v) * static_cast<double>(o.ny) * o.spacing, 0.0});
            mesh.uvs[i] = {static_cast<float>(u), static_cast<float>(v)};
            if (column == across || row == down) continue;
            const auto below = static_cast<std::uint32_t>(n + across + 1);
            const auto here = static_cast<std::uint32_t>(n);
            const auto quad = static_cast<std::size_t>(row * across + column);
            mesh.triangles[2 * quad] = {here, below, below + 1};
            mesh.triangles[2 * quad + 1] = {here, below + 1, here + 1};
        }
    });
    return mesh;
}

/// Half the width of a leaf shape at height t (0 root, 1 tip), relative to half its atlas part.
double leaf_half_width(int shape, double t) {
    const double blade = 0.95 * std::pow(1.0 - t, 0.7) * (0.4 + 0.6 * std::min(1.0, 3.0 * t));
    switch (shape) {
    case 0: return blade;
    case 1: return blade * (1.0 - 0.25 * std::fmod(20.0 * t, 1.0));                  // saw edge
    case 2: return t > 0.6 ? blade * std::abs(std::cos(15.0 * kPi * t)) : blade;     // torn tip
    default: return std::max(0.08, 1.1 * blade * std::abs(std::sin(9.0 * kPi * t))); // leaflets
    }
}

/// The leaves' texture: sRGB green, darker at the root, with a light midrib; alpha masks the shape.
Texture make_leaf_atlas(std::uint64_t seed) {
    Texture t;
    t.name = "leaves";
    t.width = kLeafShapes * kLeafWidth;
    t.height = kLeafHeight;
    t.channels = 4;
    t.srgb = true;
    t.wrap_u = t.wrap_v = Wrap::Clamp;
    t.texels.reserve(std::size_t{4} * kLeafShapes * kLeafWidth * kLeafHeight);
    for (int y = 0; y < t.height; ++y) {
        const double up = 1.0 - (y + 0.5) / kLeafHeight;
        for (int x = 0; x < t.width; ++x) {
            const double across = (x % kLeafWidth + 0.5) / (0.5 * kLeafWidth) - 1.0;
            const double inside = leaf_half_width(x / kLeafWidth, up) - std::abs(across);
            const double vein = 0.12 * streak(seed, y, x, 40.0);
            const double light =
                (0.45 + 0.55 * up) * (1.0 + vein + (std::abs(across) < 0.06 ? 0.3 : 0.0));
            t.texels.push_back(to_byte(0.38 * light));
            t.texels.push_back(to_byte(0.62 * light));
            t.texels.push_back(to_byte(0.2 * light));
            t.texels.push_back(to_byte(0.5 + inside * 0.5 * kLeafWidth)); // a ramp of one texel
        }
    }
    return t;
}

/// A leaf blade: a strip of quads that bends over, from a random root on the ground y = 0.
struct Blade {
    Vec3d root, across, lean; ///< `across` the strip; `lean`: where it bends; horizontal units
    double height = 1.0, half_width = 1.0, tilt = 0.0, bend = 1.0;
    int leaf = 0;

    /// The angle from upright at fraction t in [0, 1] of the length.
    [[nodiscard]] double angle(double t) const { return tilt + bend * t; }
    [[nodiscard]] Vec3d at(double t) const { // the integral of (sin, cos) of the slope
        return root + (lean * (std::cos(tilt) - std::cos(angle(t))) +
                       Vec3d{0.0, 1.0, 0.0} * (std::sin(angle(t)) - std::sin(tilt))) *
                          (height / bend);
    }
    [[nodiscard]] Vec3d normal(double t) const {
        return lean * std::cos(angle(t)) - Vec3d{0.0, 1.0, 0.0} * std::sin(angle(t));
    }
};

Blade make_blade(const GenerateOptions& o, std::int64_t i) {
    CounterRandom random{o.seed, static_cast<std::uint64_t>(i)};
    const auto unit = [&] { return static_cast<double>(random.uniform()); };
    const double side = std::sqrt(static_cast<double>(o.nx)) * o.spacing;
    const double turn = 2.0 * kPi * unit();
    Blade b;
    b.root = {side * unit(), 0.0, side * unit()};
    b.lean = {std::cos(turn), 0.0, std::sin(turn)};
    b.across = {std::sin(turn), 0.0, -std::cos(turn)};
    b.height = 20.0 * o.radius * (0.5 + unit());
    b.half_width = o.radius * (0.7 + 0.6 * unit());
    b.tilt = 0.35 * unit();
    b.bend = 0.2 + 1.1 * unit();
    b.leaf = static_cast<int>(unit() * kLeafShapes);
    return b;
}

void fill_blade(Mesh& mesh, const GenerateOptions& o, std::int64_t i) {
    const Blade b = make_blade(o, i);
    const std::int64_t first = 2 * i * (o.ny + 1);
    for (std::int64_t row = 0; row <= o.ny; ++row) {
        const double t = static_cast<double>(row) / static_cast<double>(o.ny);
        for (int right = 0; right < 2; ++right) {
            const auto v = static_cast<std::size_t>(first + 2 * row + right);
            mesh.positions[v] = to_float(b.at(t) + b.across * (b.half_width * (2.0 * right - 1.0)));
            mesh.normals[v] = to_float(b.normal(t));
            mesh.uvs[v] = {static_cast<float>(b.leaf + right) / kLeafShapes,
                           static_cast<float>(1.0 - t)};
        }
        if (row == o.ny) continue;
        const auto n = static_cast<std::uint32_t>(first + 2 * row);
        const auto quad = static_cast<std::size_t>(2 * (i * o.ny + row));
        mesh.triangles[quad] = {n, n + 1, n + 3};
        mesh.triangles[quad + 1] = {n, n + 3, n + 2};
    }
}

} // namespace

Geometry generate_brushed(const GenerateOptions& o) {
    Geometry geometry;
    geometry.meshes.push_back(make_plate(o));
    geometry.textures.push_back(
        make_texture("anisotropy", o, [&](std::int64_t x, std::int64_t y, std::uint8_t* rgb) {
            const double angle = 0.3 * brushing(o.seed, x, y); // radians from the tangent
            rgb[0] = to_byte(0.5 + 0.5 * std::cos(angle));
            rgb[1] = to_byte(0.5 + 0.5 * std::sin(angle));
            rgb[2] = to_byte(0.85 + 0.15 * brushing(o.seed + 10, x, y));
        }));
    geometry.textures.push_back(
        make_texture("roughness", o, [&](std::int64_t x, std::int64_t y, std::uint8_t* rgb) {
            rgb[0] = 255;
            rgb[1] = to_byte(0.35 + 0.2 * brushing(o.seed + 20, x, y));
            rgb[2] = 255; // all metal
        }));
    geometry.materials.push_back({.name = "brushed metal",
                                  .albedo = {0.91f, 0.92f, 0.92f},
                                  .roughness = 1.0f,
                                  .metalness = 1.0f,
                                  .anisotropy = 1.0f,
                                  .metal_rough_map = 1,
                                  .anisotropy_map = 0});
    return geometry;
}

Geometry generate_grass(const GenerateOptions& o) {
    const Sizes size = sizes(o);
    Geometry geometry;
    Mesh& mesh = geometry.meshes.emplace_back();
    mesh.positions.resize(static_cast<std::size_t>(size.vertices));
    mesh.normals.resize(mesh.positions.size());
    mesh.uvs.resize(mesh.positions.size());
    mesh.triangles.resize(static_cast<std::size_t>(size.triangles));
    parallel_chunks(static_cast<std::size_t>(o.nx), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) fill_blade(mesh, o, static_cast<std::int64_t>(i));
    });
    geometry.textures.push_back(make_leaf_atlas(o.seed));
    geometry.materials.push_back({.name = "grass",
                                  .albedo = {1.0f, 1.0f, 1.0f},
                                  .roughness = 0.7f,
                                  .alpha_mode = AlphaMode::Mask,
                                  .albedo_map = 0});
    return geometry;
}

} // namespace heddle::generate_parts
